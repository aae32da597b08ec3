#include "properties/laws/failure_file.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/files/configuration_json.hpp"
#include "properties/identity.hpp"
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
          nullptr};
}

TEST(FailureFile, ComesBackBitForBit) {
  const Failure f = failure(), back = failure_from_json(to_json(f));
  EXPECT_EQ(to_json(back), to_json(f));
  EXPECT_EQ(to_hex_json(back.configuration), to_hex_json(f.configuration));
}

TEST(FailureFile, NamesWhatIsWrong) {
  const auto message = [](const char* member, const json& value) {
    json object = to_json(failure());
    object[member] = value;
    try {
      failure_from_json(object);
    } catch (const InvalidInput& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(message("schema", "another"), testing::HasSubstr("touchstone-failure-1"));
  EXPECT_THAT(message("law", "gravity"), testing::HasSubstr("agreement"));
  EXPECT_THAT(message("failure", "bad"), testing::HasSubstr("missed"));
  EXPECT_THAT(message("tolerance", "wide"), testing::HasSubstr("tolerance"));
  EXPECT_THAT(message("configuration", nullptr), testing::Not(testing::HasSubstr("accepted")));
}

TEST(FailureFile, ASavedFailureReplacesItself) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "corpus";
  std::filesystem::remove_all(folder);
  const auto first = save(failure(), folder), second = save(failure(), folder);
  EXPECT_EQ(first, second);
  EXPECT_EQ(read_corpus(folder).size(), 1u);
  std::ofstream(folder / "x.json") << "[";
  EXPECT_THROW(read_corpus(folder), InvalidInput);
  EXPECT_THROW(read_corpus(folder / "none"), InvalidInput);
}

TEST(Corpus, AJsonLinesFileHoldsOneFailureOnEachLine) {
  const auto file = std::filesystem::path(testing::TempDir()) / "failures.jsonl";
  const std::string line = to_json(failure()).dump() + '\n';
  std::ofstream(file) << line << '\n' << line;
  EXPECT_EQ(read_corpus(file).size(), 2u);
  std::ofstream(file) << line << '\n' << "[\n";
  try {
    read_corpus(file);
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("line 3"));
  }
}

TEST(Corpus, ACandidateThatIsNotInstalledIsSkipped) {
  Failure f = failure();
  f.candidate = "havok";
  const auto replayed = replay({f}, {});
  EXPECT_EQ(replayed.at(0).result, ReplayedFailure::Result::skipped);
}

TEST(Corpus, SeesWhatIsFixedAndWhatHasChanged) {
  Failure kept = failure();
  kept.candidate = "reference";
  EXPECT_EQ(replay({kept}, {}).at(0).result, ReplayedFailure::Result::fixed);
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
