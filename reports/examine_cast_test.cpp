#include "reports/examine_cast.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/solve.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A can of 1 m half length, let down by 9 m onto a unit sphere from 5 m.
json let_down() {
  return json::parse(R"({"a":{"shape":"cylinder","radius":0.5,"half_length":1},
      "pose_a":{"position":[0,0,5]},"b":{"shape":"sphere","radius":1},"sweep":[0,0,-9]})");
}

json solved_line(const json& line, bool csv = false) {
  std::istringstream in(line.dump());
  std::ostringstream out;
  solve(in, out,
        {.candidates = find_candidates({"reference", "bullet", "ode"}),
         .width = 1e-15,
         .bar = {},
         .csv = csv});
  return csv ? json(out.str()) : json::parse(out.str());
}

TEST(SolvedCast, HasItsFractionAndTheTruthThere) {
  const json cast = solved_line(let_down())["cast"];
  EXPECT_EQ(cast["truth"]["status"], "touch");
  EXPECT_THAT(cast["truth"]["fraction"][0].get<std::string>(), HasSubstr("0.3333333333333333"));
  EXPECT_EQ(cast["truth"]["there"]["normals"], json::array({{0.0, 0.0, 1.0}}));
  EXPECT_NEAR(cast["truth"]["there"]["patch"][0]["centroid"][2].get<double>(), 1, 1e-15);
  const json& answer = cast["answers"]["reference"];
  EXPECT_EQ(answer["status"], "touch");
  EXPECT_NEAR(answer["fraction"].get<double>(), 1.0 / 3, 1e-15);
  EXPECT_EQ(answer["score"]["outcome"], "agree");
  EXPECT_EQ(cast["answers"]["bullet"]["score"]["outcome"], "agree");
  EXPECT_FALSE(cast["answers"].contains("ode")) << "which has no casts";
}

TEST(SolvedCast, BulletsRoundedRimIsLateOnASphere) {
  const json cast = solved_line(json::parse(
      R"({"a":{"shape":"cylinder","radius":0.5,"half_length":0.25},
          "pose_a":{"position":[-5.5,0,0.75]},"b":{"shape":"sphere","radius":1},"sweep":[8,0,0]})"))
      ["cast"];
  EXPECT_EQ(cast["answers"]["reference"]["score"]["outcome"], "agree");
  const json& bullet = cast["answers"]["bullet"]["score"];
  EXPECT_EQ(bullet["outcome"], "late");
  EXPECT_LT(bullet["distance"].get<double>(), -0.01);
}

TEST(SolvedCast, OfFclIsOneOfTenPosesUnlessItAdvances) {
  // Onto a box's top, at a third: the poses tried are ninths of the way, and the fourth is inside.
  json line = let_down();
  line["b"] = json::parse(R"({"shape":"box","half_extents":[0.5,0.5,1]})");
  std::istringstream in(line.dump());
  std::ostringstream out;
  solve(in, out,
        {.candidates = find_candidates({"fcl", "fcl-distance", "fcl-indep"}),
         .width = 1e-15,
         .bar = {},
         .csv = false});
  const json answers = json::parse(out.str())["cast"]["answers"];
  EXPECT_NEAR(answers["fcl"]["fraction"].get<double>(), 4.0 / 9, 1e-12);
  EXPECT_EQ(answers["fcl"]["score"]["outcome"], "late");
  EXPECT_EQ(answers["fcl-distance"]["score"]["outcome"], "agree");
  EXPECT_TRUE(answers["fcl-distance"]["score"]["normal_regret"].is_null()) << "it says no normal";
  EXPECT_FALSE(answers.contains("fcl-indep"));
}

TEST(SolvedCast, WithoutASweepThereIsNone) {
  json line = let_down();
  line.erase("sweep");
  EXPECT_FALSE(solved_line(line).contains("cast"));
  line["sweep"] = {0, 0, 0};
  EXPECT_EQ(solved_line(line)["cast"]["truth"]["status"], "never");
  line["pose_a"]["position"] = {0, 0, 2};
  EXPECT_EQ(solved_line(line)["cast"]["truth"]["status"], "from-start");
}

TEST(SolvedCast, OfAnotherBodyAIsSeenFromThere) {
  // The sphere is raised to the can's lower cap, at 4 m: after 3 of 9 m.
  json line = let_down();
  std::swap(line["a"], line["b"]);
  line["pose_b"] = line["pose_a"];
  line.erase("pose_a");
  line["sweep"] = {0, 0, 9};
  const json cast = solved_line(line)["cast"];
  EXPECT_THAT(cast["truth"]["fraction"][0].get<std::string>(), HasSubstr("0.3333333333333333"));
  EXPECT_EQ(cast["truth"]["there"]["normals"][0][2], -1.0);
  EXPECT_NEAR(cast["truth"]["there"]["patch"][0]["centroid"][2].get<double>(), 4, 1e-15);
  EXPECT_EQ(cast["answers"]["reference"]["normal"][2], -1.0);
  line["spin"] = {0, 0, 1};
  EXPECT_EQ(solved_line(line)["field"], "spin");
}

TEST(SolvedCast, WithASpinIsTheTruthAlone) {
  json line = let_down();
  line["spin"] = {0.1, 0, 0};
  const json cast = solved_line(line)["cast"];
  EXPECT_EQ(cast["truth"]["status"], "touch");
  EXPECT_TRUE(cast["answers"].empty());
}

TEST(SolvedCast, HasNoColumnsInCsv) {
  EXPECT_THAT(solved_line(let_down(), true).get<std::string>(),
              HasSubstr("sweep is given: must be left out beside --csv"));
}

TEST(CastText, SaysWhenAndWhatWasAnswered) {
  const GivenConfiguration given = cast_from_json(let_down());
  const std::string text = cast_text(
      examine_cast(given.configuration, *given.sweep, find_candidates({"reference"}), Bar()));
  EXPECT_THAT(text, HasSubstr("A touches B first when it has gone 0.3333"));
  EXPECT_THAT(text, HasSubstr("normal (0, 0, 1)"));
  EXPECT_THAT(text, testing::ContainsRegex("\n +agree +touch +0.3333 "));
  EXPECT_THAT(text, HasSubstr(R"("sweep":[0.0,0.0,-9.0])"));
}

TEST(CastText, SaysThatNothingIsTouched) {
  json line = let_down();
  line["sweep"] = {9, 0, 0};
  const GivenConfiguration given = cast_from_json(line);
  EXPECT_THAT(cast_text(examine_cast(given.configuration, *given.sweep, {}, Bar())),
              HasSubstr("A touches B never in its sweep"));
}

}  // namespace
}  // namespace touchstone
