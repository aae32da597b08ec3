#include "reports/stability/stability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "candidates/candidates.hpp"
#include "properties/motions/motion.hpp"
#include "reference/invalid_input.hpp"
#include "reports/stability/stability_page.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Study study(const std::vector<std::string>& names, unsigned workers = 2) {
  Study s;
  s.candidates = find_candidates(names);
  s.workers = workers;
  return s;
}

/// A few of everything.
StabilityOptions small(const Study& of) {
  StabilityOptions options = brief(of, {Pair::plane, Pair::capsule}, 3);
  options.ladder.cells = {{Pair::plane, "standing"}, {Pair::capsule, "coaxial"}};
  options.ladder.count = 2;
  options.grid.stride = 8;
  options.steps = 10;
  return options;
}

TEST(Stability, DoesNotDependOnTheNumberOfWorkers) {
  EXPECT_EQ(stability(small(study({"reference", "bullet", "ode"}, 1))),
            stability(small(study({"reference", "bullet", "ode"}, 3))));
}

/// "Done when": the depth of our routines changes by no more than a step allows, on every rung of
/// every degenerate class.
TEST(Stability, OurDepthIsAmplifiedByNoMoreThanTheStepAllows) {
  Ladder ladder{degenerate_cells({std::begin(all_pairs), std::end(all_pairs)}), 5, 3};
  const json result = amplification(ladder, study({"reference"}));
  EXPECT_EQ(result["results"].size(), ladder.cells.size());
  for (const json& row : result["results"]) {
    for (const json& none : row["unanswered"]) EXPECT_EQ(none, 0);
    for (const json& missed : row["missed"]) EXPECT_EQ(missed, 0);
  }
  EXPECT_FALSE(result["worst"].empty());
  for (const json& w : result["worst"]) {
    if (w["measure"] != "amplification") continue;
    EXPECT_LE(w["value"].get<double>(), 1 + 1e-9) << w;
  }
}

/// "Done when": no missed contact in any map; and no other failure either.
TEST(Stability, OurMapsAreOfOneColour) {
  std::vector<const CriticalPose*> poses;
  for (const CriticalPose& pose : critical_poses()) poses.push_back(&pose);
  MapGrid grid{{}, 4};
  for (const int exponent : {-15, -12, -8, -4, -2}) grid.zooms.emplace_back(exponent);
  const json result = maps(poses, grid, study({"reference"}));
  for (const json& pose : result["poses"]) {
    ASSERT_EQ(pose["results"].size(), 1u);
    for (const json& letters : pose["results"][0]["maps"]) {
      EXPECT_EQ(letters, "81.") << pose["pose"];
    }
  }
}

TEST(Stability, OurMotionsAreAsSmoothAsTheTruth) {
  std::vector<const Motion*> all;
  for (const Motion& motion : motions()) all.push_back(&motion);
  const json result = sequences(all, 40, study({"reference"}));
  for (const json& motion : result["motions"]) {
    const json& ours = motion["results"][0];
    EXPECT_EQ(ours["missed"], 0) << motion["motion"];
    EXPECT_EQ(ours["wrong"], 0) << motion["motion"];
    EXPECT_LT(ours["jump"]["value"].get<double>(), 1e-14) << motion["motion"];
    EXPECT_LE(ours["amplification"], 1) << motion["motion"];
  }
}

/// A candidate that is wrong in a known way at known places.
json result_of(const json& list, const std::string& candidate) {
  for (const json& result : list) {
    if (result["candidate"] == candidate) return result;
  }
  return nullptr;
}

TEST(Stability, ColoursALineHeldByOnePoint) {
  // ODE has two points under a lying cylinder, one between parallel sides.
  const json result = maps({&find_critical_pose("lying"), &find_critical_pose("parallel-sides")},
                           {{Decade(-12)}, 8}, study({"ode"}));
  const auto middle = [&](int pose) {
    return map_letters_of(result["poses"][pose]["results"][0]["maps"][0]).at(12);
  };
  EXPECT_EQ(middle(0), '.');
  EXPECT_EQ(middle(1), 'f');
}

TEST(MapLetters, AreWrittenInRunLengths) {
  EXPECT_EQ(map_letters_of("3m2.f12."), "mmm..f............");
  EXPECT_EQ(map_letters_of(""), "");
}

TEST(Stability, MeasuresAJumpThatTheStepDoesNotExplain) {
  // libccd's EPA, which MuJoCo calls, ends at another depth for every hair.
  const json result =
      amplification(subject(parse_identity("cylinder-sphere/concentric-aligned/1/0")), 1, 3,
                    study({"reference", "mujoco"}));
  const json ours = result_of(result["results"], "reference"),
             theirs = result_of(result["results"], "mujoco");
  EXPECT_LT(ours["jump"].get<double>(), 1e-14);
  EXPECT_GT(theirs["jump"].get<double>(), 0.01);
  const json& worst = result["worst"][0];
  EXPECT_EQ(worst["candidate"], "mujoco");
  EXPECT_GT(worst["value"].get<double>(), 1e6);
}

TEST(Stability, ReplaysItsWorstSteps) {
  const json result = stability(small(study({"bullet"})));
  ASSERT_FALSE(result["amplification"]["worst"].empty());
  for (const json& w : result["amplification"]["worst"]) {
    const std::string to = w["to"], from = w["from"];
    const std::size_t at = to.rfind('@');
    EXPECT_EQ(to.substr(0, at), from);
    EXPECT_NO_THROW(parse_perturbation(to.substr(at + 1)));
  }
}

TEST(Stability, CountsACandidateThatDies) {
  add_plugin(std::filesystem::path(TOUCHSTONE_TEST_PLUGINS) / "touchstone-sabotage.so");
  StabilityOptions options = small(study({"sabotage", "reference"}));
  options.ladder.cells = {{Pair::capsule, "coaxial"}};
  options.ladder.count = 6;
  const json result = stability(options);
  const json died = result_of(result["amplification"]["results"], "sabotage");
  int unanswered = 0;
  for (const json& n : died["unanswered"]) unanswered += n.get<int>();
  EXPECT_GT(unanswered, 0);
  EXPECT_LT(unanswered, 6 * 16);
  // Who else is asked makes no difference.
  StabilityOptions alone = options;
  alone.study = study({"reference"});
  EXPECT_EQ(result_of(stability(alone)["amplification"]["results"], "reference"),
            result_of(result["amplification"]["results"], "reference"));
}

TEST(StabilityTable, IsNoWiderThanATerminal) {
  std::istringstream lines(
      stability_table(stability(small(study({"reference", "bullet-float-margin-0"})))));
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" replay ") != std::string::npos) continue;  // never broken: to be copied
    EXPECT_LE(line.size(), 80u) << line;
  }
}

TEST(StabilityPage, CarriesTheResultAndNoPlaceholder) {
  const std::string page =
      stability_page({{"command", "</script>x"}, {"candidates", json::array()}});
  EXPECT_THAT(page, HasSubstr("\\u003c/script>x"));
  for (const char* left : {"/* report.", "/* elements.", "/* stability."}) {
    EXPECT_THAT(page, testing::Not(HasSubstr(left)));
  }
}

}  // namespace
}  // namespace touchstone
