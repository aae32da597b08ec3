// Needs that exact contacts do not decide, because exact runs differ by more than these allow.
#include "simulation/scenes/spread.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "candidates/candidates.hpp"
#include "reference/error_of_test.hpp"
#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/engine_choice.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

/// A roller in balance on a fixed one, as long as nothing disturbs it, and these needs.
SceneFile balanced_roller(const std::string& needs) {
  return scene_from_text(R"({
    "duration": 1.5,
    "bodies": [
      {"name": "lower", "shape": {"shape": "cylinder", "radius": 0.1, "half_length": 0.2}, "fixed": true},
      {"name": "upper", "shape": {"shape": "cylinder", "radius": 0.05, "half_length": 0.2},
       "pose": {"position": [0, 0.15, 0]}}],
    "gravity": [0, -9.81, 0],
    "needs": [)" + needs + "]}",
                         "rollers.json");
}
const char* const ends_near = R"({"need": "ends-near", "body": "upper", "metres": 0.03})";
const char* const ends_anywhere = R"({"need": "ends-near", "body": "upper", "metres": 900})";
const char* const overlaps = R"({"need": "penetration", "metres": 0.005})";
const std::string both = std::string(overlaps) + ", " + ends_near;

/// A run of the two rollers that ends with the upper one at this height, m.
Trajectory ending_at(double height) {
  Trajectory run;
  run.step = 1;
  for (const double y : {0.15, height}) {
    run.frames.push_back(
        {{Pose(), Vec3::Zero(), Vec3::Zero()}, {Pose(Vec3(0, y, 0)), Vec3::Zero(), Vec3::Zero()}});
  }
  return run;
}

TEST(Spread, IsTheLargestDifferenceOfTwoExactRuns) {
  const SceneFile file = balanced_roller(ends_near);
  constexpr double rounding = 1e-15;
  const auto of = [&](const std::vector<Trajectory>& runs) {
    return spread(*file.needs[0], file.scene, runs);
  };
  EXPECT_EQ(of({ending_at(1)}), 0);
  EXPECT_NEAR(of({ending_at(1), ending_at(1.5), ending_at(0.75)}), 0.75, rounding);
}

TEST(Spread, DecidesANeedUpToItsLimit) {
  for (const double apart : {0.02, 0.0625}) {
    SceneFile file = balanced_roller(both);
    const Spreads spreads = take_undecidable(file, {ending_at(1), ending_at(1 + apart)});
    const bool is_decided = apart < 0.03;
    ASSERT_EQ(file.needs.size(), is_decided ? 2U : 1U);
    EXPECT_FALSE(spreads.of_needs[0]);  // which is not relative
    EXPECT_EQ(spreads.of_needs.size(), file.needs.size());
    if (is_decided) {
      EXPECT_NEAR(spreads.of_needs[1].value(), apart, 1e-15);
      continue;
    }
    ASSERT_EQ(spreads.undecidable.size(), 1U);
    EXPECT_EQ(spreads.undecidable[0].text, "upper ends within 0.03 m of the exact place");
    EXPECT_EQ(spreads.undecidable[0].limit, 0.03);
    EXPECT_EQ(spreads.undecidable[0].spread, 0.0625);
  }
}

// A robot's wheels that touch nothing end where the others do not: what is asked of it, for want of
// anyone who says, must not be dropped because exact runs differ.
TEST(Spread, WidensWhatNobodyAskedFor) {
  SceneFile file = balanced_roller(overlaps);
  file.needs.push_back(ends_near_need(1, 0.03));
  const Spreads spreads = take_undecidable(file, {ending_at(1), ending_at(1.0625)});
  EXPECT_TRUE(spreads.undecidable.empty());
  ASSERT_EQ(file.needs.size(), 2U);
  EXPECT_EQ(file.needs[1]->text(file.scene), "upper ends within 0.063 m of the exact place");
  EXPECT_EQ(spreads.of_needs[1], 0.0625);

  // Within its limit it stays as it is; a tilt of anything is nothing to ask for.
  take_undecidable(file, {ending_at(1), ending_at(1.01)});
  EXPECT_EQ(file.needs[1]->text(file.scene), "upper ends within 0.063 m of the exact place");
  file.needs = {penetration_need(1, 0.01), ends_tilted_need(1, 1)};
  Trajectory lying = ending_at(1);
  lying.frames.back()[1].pose =
      Pose(Vec3::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(2, Vec3::UnitX())));
  EXPECT_EQ(take_undecidable(file, {ending_at(1), lying}).undecidable.size(), 1U);
}

// A rod that a kick rolls on ends where the kick takes it, contacts or none: that it moves no
// further in a model is worth asking, and decided by the exact run under the same kick.
TEST(Spread, ThatDisturbancesCarryDecidesAllTheSame) {
  const Choice choice =
      choose(read_scene(TOUCHSTONE_SCENES "/rod-on-table.json"), {{}, 1, {}, {.disturbances = 2}});
  EXPECT_TRUE(choice.spreads.undecidable.empty());
  EXPECT_GT(choice.spreads.of_needs[0].value(), choice.runs[0].verdicts[0].limit);
}

TEST(Spread, ThatDisturbancesCarryIsTheirShiftTheirKickAndTheirTurn) {
  const SceneFile file = balanced_roller(ends_near);
  const Scene& scene = file.scene;
  const auto [metres, radians] = carrying(scene, 1, 2);
  const double kick = 1e-3 * std::sqrt(2 * 9.81 * 0.1);  // of the fall by its width of 0.1 m
  EXPECT_NEAR(metres, 2 * (1e-4 * 0.1 + kick * 1.5 + 1e-3 * 2), 1e-12);
  EXPECT_NEAR(radians, 2e-3, 1e-15);
  EXPECT_EQ(carrying(scene, 0, 2).metres, 0);  // which is fixed
}

// As it is written the roller stays; disturbed, it falls to either side. A capsule, which answers
// the same contact, ends as far from the exact run as another exact run does.
TEST(Spread, OfExactRunsDecidesWhatAModelIsJudgedBy) {
  const ChooseOptions options{find_candidates({"capsule"}), 1, {}, {.disturbances = 2}};
  const Choice choice = choose(balanced_roller(both), options);
  ASSERT_EQ(choice.spreads.undecidable.size(), 1U);
  EXPECT_GT(choice.spreads.undecidable[0].spread, 0.2);
  ASSERT_EQ(choice.file.needs.size(), 1U);
  for (const SceneRun& run : choice.runs) EXPECT_EQ(run.verdicts.size(), 1U);

  const Choice wide = choose(balanced_roller(ends_anywhere), options);
  EXPECT_TRUE(wide.spreads.undecidable.empty());
  EXPECT_NEAR(wide.spreads.of_needs[0].value(), choice.spreads.undecidable[0].spread, 1e-12);
}

TEST(Spread, OfRunsInAnEngineDecidesWhatItsShapesAreJudgedBy) {
  const EngineChoice choice =
      choose_in_engine(balanced_roller(both), "ode", {.trials = {.disturbances = 1}});
  ASSERT_EQ(choice.spreads.undecidable.size(), 1U);
  EXPECT_GT(choice.spreads.undecidable[0].spread, 0.2);
  EXPECT_EQ(choice.default_setting().verdicts.size(), 1U);
}

TEST(Spread, LeavesNoChoiceWhereEveryNeedIsWithinIt) {
  SceneFile file = balanced_roller(ends_near);
  const auto error = error_of([&] { take_undecidable(file, {ending_at(1), ending_at(2)}); });
  EXPECT_EQ(error.field(), "needs");
  EXPECT_THAT(error.what(), HasSubstr("upper ends within 0.03 m of the exact place"));
  EXPECT_THAT(error.what(), HasSubstr("must allow more than 1 m, by which exact runs differ"));
}

}  // namespace
}  // namespace touchstone
