#include "properties/laws/failure_file.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/identity.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

Failure failure() {
  return {"agreement",
          "bullet",
          "3.24",
          "cylinder-box/edge-cap/1/0",
          make_configuration({Pair::box, "edge-cap", 1, 0}),
          {"missed", 0.5, "far off"},
          {1e-4, 0.25},
          {},
          {}};
}

/// Two points, one of whose depths is not a number, and some errors of its score.
Failure failure_with_answer() {
  Failure f = failure();
  ts_answer& answer = f.answer.emplace();
  answer.status = TS_CONTACT;
  answer.signed_distance = -0.1;
  answer.normal[1] = -1;
  answer.point_count = 2;
  answer.points[0] = {{1, 2, 3}, {0, 1, 0}, 0.25};
  answer.points[1] = {{4, 5, 6}, {0, 0, 1}, std::numeric_limits<double>::quiet_NaN()};
  f.score.outcome = Outcome::wrong_normal;
  f.score.depth_error = 1e-3;
  f.score.coverage = 0.5;
  return f;
}

TEST(FailureFile, ComesBackBitForBit) {
  const Failure f = failure(), back = failure_from_json(to_json(f));
  EXPECT_EQ(to_json(back), to_json(f));
  EXPECT_EQ(to_hex_json(back.configuration), to_hex_json(f.configuration));
}

TEST(FailureFile, OfACastHasItsSweep) {
  Failure f = failure();
  f.law = "cast-free";
  f.sweep = Vec3(0, -1.0 / 3, 0);
  const json written = to_json(f);
  const Failure back = failure_from_json(written);
  EXPECT_EQ(to_json(back), written);
  ASSERT_TRUE(back.sweep);
  EXPECT_EQ(*back.sweep, *f.sweep);
  f.sweep.reset();
  EXPECT_THAT(error_text_of([&] { failure_from_json(to_json(f)); }),
              testing::HasSubstr("law is \"cast-free\": must be one of contacts"));
}

TEST(FailureFile, KeepsTheAnswer) {
  const Failure f = failure_with_answer(), back = failure_from_json(to_json(f));
  EXPECT_EQ(to_json(back), to_json(f));
  ASSERT_TRUE(back.answer);
  EXPECT_EQ(back.answer->signed_distance, -0.1);
  EXPECT_EQ(back.answer->normal[1], -1);
  ASSERT_EQ(back.answer->point_count, 2);
  EXPECT_EQ(back.answer->points[0].position[2], 3);
  EXPECT_EQ(back.answer->points[1].normal[2], 1);
  EXPECT_TRUE(std::isnan(back.answer->points[1].depth));
  EXPECT_EQ(back.score.outcome, Outcome::wrong_normal);
  EXPECT_EQ(back.score.depth_error, 1e-3);
  EXPECT_EQ(back.score.normal_angle, std::nullopt);
}

TEST(FailureFile, NamesWhatIsWrong) {
  const auto message = [](const char* member, const json& value) {
    json object = to_json(failure());
    object[member] = value;
    return error_text_of([&] { failure_from_json(object); });
  };
  EXPECT_THAT(message("schema", "another"), testing::HasSubstr("touchstone-failure-1"));
  EXPECT_THAT(message("law", "gravity"), testing::HasSubstr("agreement"));
  EXPECT_THAT(message("failure", "bad"), testing::HasSubstr("missed"));
  EXPECT_THAT(message("tolerance", "wide"), testing::HasSubstr("tolerance"));
  EXPECT_THAT(message("configuration", nullptr), testing::Not(testing::HasSubstr("accepted")));
  EXPECT_THAT(message("answer", {{"status", "perhaps"}}), testing::HasSubstr("answer.status"));
  json answer = to_json(failure_with_answer())["answer"];
  answer["points"][1]["position"][2] = "far";
  EXPECT_THAT(message("answer", answer), testing::HasSubstr("answer.points[1].position[2]"));
}

TEST(FailureFile, ASavedFailureReplacesItself) {
  const OwnFolder own;
  const auto first = save(failure(), own.path), second = save(failure(), own.path);
  EXPECT_EQ(first, second);
  EXPECT_EQ(read_corpus(own.path).size(), 1u);
  own.with("x.json", "[");
  EXPECT_THROW(read_corpus(own.path), InvalidInput);
  EXPECT_THROW(read_corpus(own.path / "none"), InvalidInput);
}

TEST(FailureFile, MayHoldOneFailureALine) {
  const OwnFolder own;
  const std::string line = to_json(failure()).dump() + "\n\n";
  const auto corpus =
      read_corpus(own.with("failures.jsonl", line + to_json(failure_with_answer()).dump()));
  ASSERT_EQ(corpus.size(), 2u);
  EXPECT_FALSE(corpus[0].answer);
  EXPECT_TRUE(corpus[1].answer);
  for (const auto& [second, error] : {std::pair("{}", "failure 2.schema"), {"[\n", "line 3"}}) {
    const auto file = own.with("failures.jsonl", line + second);
    EXPECT_THAT(error_text_of([&] { read_corpus(file); }), testing::HasSubstr(error));
  }
}

TEST(Corpus, ACandidateThatIsNotInstalledIsSkipped) {
  Failure f = failure();
  f.candidate = "no-such-engine";
  const auto replayed = replay({f}, {});
  EXPECT_EQ(replayed.at(0).result, ReplayedFailure::Result::skipped);
}

TEST(Corpus, SeesWhatIsFixedAndWhatHasChanged) {
  Failure kept = failure();
  kept.candidate = "reference";
  EXPECT_EQ(replay({kept}, {}).at(0).result, ReplayedFailure::Result::fixed);
}

TEST(Corpus, AsksForCastsAgain) {
  // A can beside a ball moves away from it, as no routine gets wrong, and ODE has no casts.
  Failure f = failure();
  f.law = "cast-free";
  f.sweep = Vec3(0, 0, 1);
  for (const auto& [candidate, result] :
       {std::pair("bullet", ReplayedFailure::Result::fixed),
        std::pair("ode", ReplayedFailure::Result::changed),
        std::pair("no-such-engine", ReplayedFailure::Result::skipped)}) {
    f.candidate = candidate;
    f.configuration = {Cylinder(1, 1), Pose({0, 0, 3}, {1, 0, 0, 0}), Sphere(1), Pose()};
    EXPECT_EQ(replay({f}, {}).at(0).result, result) << candidate;
  }
}

TEST(FailureFile, KeepsTheFeaturesAndIsNamedAfterThem) {
  Failure f = failure();
  f.features = "rim-edge";
  EXPECT_EQ(failure_from_json(to_json(f)).features, "rim-edge");
  EXPECT_THAT(save(f, OwnFolder().path).string(),
              testing::EndsWith("-agreement-missed-rim-edge.json"));
  EXPECT_FALSE(to_json(failure()).contains("features"));
}

// A new version of an engine that mends or breaks one of these is to be noticed.
TEST(Corpus, KnownFailuresFailAsTheyDid) {
  const auto corpus = read_corpus(TOUCHSTONE_KNOWN_FAILURES);
  EXPECT_GE(corpus.size(), 51u);
  for (const ReplayedFailure& r : replay(corpus, {})) {
    EXPECT_TRUE(r.result == ReplayedFailure::Result::as_expected ||
                r.result == ReplayedFailure::Result::skipped)
        << r.expected.candidate << ", " << r.expected.law << ", " << r.expected.violation.failure
        << ": now \"" << r.now << '"';
  }
}

}  // namespace
}  // namespace touchstone
