// What runs with exact contacts say of a scene without needs, in our own world and in an engine's.
#include "simulation/scenes/exact_motion.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "candidates/candidates.hpp"
#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/engine_choice.hpp"
#include "simulation/scenes/robot_file.hpp"

namespace touchstone {
namespace {

/// A can that falls a quarter of a metre, nearly flat, on a block, beside one that floats.
Scene dropped_can() {
  Scene scene;
  scene.duration = 0.6;
  Body can{.name = "can", .shape = Cylinder(0.06, 0.06), .pose = Pose(Vec3(0, 0.2, 0.6))};
  Body block{.name = "block", .shape = Box(Vec3(0.3, 0.6, 0.3)), .fixed = true};
  Body ball{.name = "ball", .shape = Sphere(0.01), .pose = Pose(Vec3(5, 0, 50))};
  scene.bodies = {block, can, ball};
  return scene;
}

TEST(ExactMotion, HasTheLargestDepthsOfAllRunsAndTheWaysOfTheOneAsWritten) {
  const Scene scene = dropped_can();
  Processes processes({});
  CandidateModel exact(processes.of(find_candidate("reference")));
  const Trials trials{3, 7};
  ExactMotion expected = motion_of(scene, run_scene(scene, exact));
  // A fall from 0.6 m onto 0.3 m by a can that reaches 0.06 m below its centre.
  EXPECT_NEAR(expected.ways[1], 0.24, 0.03);
  EXPECT_GT(expected.depths[1], 0);
  EXPECT_EQ(expected.depths[0], expected.depths[1]);
  EXPECT_EQ(expected.depths[2], 0);
  for (std::size_t d = 1; d <= trials.disturbances; ++d) {
    const DisturbedScene disturbed(scene, trials.seed, d);
    const auto one = motion_of(scene, disturbed.turned_back(run_scene(disturbed.scene, exact)));
    for (std::size_t i = 0; i < 3; ++i) {
      expected.depths[i] = std::max(expected.depths[i], one.depths[i]);
    }
  }
  for (const unsigned workers : {1U, 3U}) {
    const ExactMotion motion = exact_motion(scene, trials, workers, {}, "can");
    EXPECT_EQ(motion.depths, expected.depths);
    EXPECT_EQ(motion.ways, expected.ways);
  }
}

/// Index of a setting, of a single size of cylinders.
const EngineSetting& setting(const EngineChoice& choice, EngineShape::Kind kind) {
  return *std::ranges::find_if(choice.settings,
                               [&](const EngineSetting& s) { return s.has(kind); });
}

// MuJoCo's contacts yield to a fall by three times what hard ones do. Limits from these, which no
// setting of it could meet, are not asked of it: the needs tell its shapes apart.
TEST(ExactMotion, InASoftEngineGivesLimitsThatItCanMeet) {
  const auto engines = all_engines();
  if (std::ranges::find(engines, "mujoco") == engines.end()) GTEST_SKIP() << "no MuJoCo";
  SceneFile file;
  file.name = "can";
  file.scene = dropped_can();
  const Trials trials{.disturbances = 1};
  const ExactMotion hard = exact_motion(file.scene, trials, 1, {}, file.name);
  const ExactMotion soft = exact_motion_in("mujoco", file.scene, trials, 1, file.name);
  constexpr double share_of_width = 0.01, width = 0.12;  // what add_robot_needs allows beside twice
  EXPECT_GT(soft.depths[1], 2 * hard.depths[1] + share_of_width * width);

  add_robot_needs(file, soft);
  const EngineChoice choice = choose_in_engine(file, "mujoco", {.trials = trials});
  ASSERT_TRUE(choice.answer);
  EXPECT_TRUE(choice.exact_setting().holds());
  EXPECT_FALSE(choice.default_setting().holds());
  EXPECT_TRUE(setting(choice, EngineShape::Kind::multipoint).holds());
}

}  // namespace
}  // namespace touchstone
