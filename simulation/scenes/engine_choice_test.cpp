// Drives, pushes and the shapes that stand for cylinders in the engines' own worlds; the choice
// among these.
#include "simulation/scenes/engine_choice.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "candidates/host/contained.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Kind = EngineShape::Kind;

const Cylinder can(0.05, 0.1);

Body ground() { return {.name = "ground", .shape = Plane(Vec3::UnitZ(), 0), .fixed = true}; }

Body standing_can() { return {.name = "can", .shape = can, .pose = Pose(Vec3(0, 0, 0.1))}; }

/// Position of the last body at the end of a run in an engine, in a process of its own.
Vec3 end_in(const std::string& engine, const Scene& scene, const EngineSetup& setup = {}) {
  const Contained ran = run_contained(
      [&] {
        const Trajectory run = run_scene(scene, in_engine(engine, setup), false);
        const Vec3& p = run.frames.back().back().pose.position();
        return json({p.x(), p.y(), p.z()}).dump();
      },
      max_engine_seconds);
  EXPECT_EQ(ran.end, Contained::End::returned) << ran.text;
  const json p = json::parse(ran.text);
  return {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()};
}

class InEngine : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Each, InEngine, testing::ValuesIn(all_engines()), [](const auto& param) {
  std::string name = param.param;
  std::erase(name, '-');
  return name;
});

TEST_P(InEngine, ADrivenPlateCarriesWhatStandsOnIt) {
  Scene scene;
  scene.duration = 1;
  Body plate{.name = "plate", .shape = Box(Vec3(0.3, 0.3, 0.02)), .pose = Pose(Vec3(0, 0, -0.02))};
  plate.drive = SteadyMotion{.velocity = Vec3(0.2, 0, 0)};
  scene.bodies = {ground(), plate, standing_can()};
  scene.bodies[0].pose = Pose(Vec3(0, 0, -1));
  // The can slides until friction, 4.9 m/s², has given it the plate's speed: 4 mm less.
  EXPECT_NEAR(end_in(GetParam(), scene).x(), 0.2, 0.008);
}

TEST_P(InEngine, ADrivenBodyFollowsItsDriveWhateverItMeets) {
  Scene scene;
  scene.duration = 0.5;
  Body ram{.name = "ram", .shape = Box(Vec3(0.02, 0.1, 0.1)), .pose = Pose(Vec3(-0.1, 0, 0.12))};
  ram.drive = SteadyMotion{.velocity = Vec3(0.4, 0, 0)};
  scene.bodies = {ground(), standing_can(), ram};
  EXPECT_NEAR(end_in(GetParam(), scene).x(), 0.1, 1e-6);
}

TEST_P(InEngine, APushActsForItsTime) {
  Scene scene;
  scene.duration = 0.5;
  scene.gravity = Vec3::Zero();
  scene.bodies = {standing_can()};
  scene.pushes = {{.body = 0, .force = Vec3(2, 0, 0), .from = 0.1, .until = 0.2}};
  const double mass = inertia(can, 1000).mass;
  // Δv = F Δt / m; on the way for 0.35 s after the middle of the push.
  EXPECT_NEAR(end_in(GetParam(), scene).x(), 2 * 0.1 / mass * 0.35, 0.02 * 2 * 0.1 / mass);
}

TEST_P(InEngine, WhatStandsForACanHoldsItAtItsOwnHeight) {
  Scene scene;
  scene.duration = 0.4;
  scene.bodies = {ground(), standing_can()};
  const auto height = [&](const EngineShape& shape) {
    return end_in(GetParam(), scene, {.shapes = {{}, shape}}).z();
  };
  constexpr double near = 0.002;  // what soft contacts yield, and margins round
  for (const EngineShape shape : {EngineShape{}, {Kind::exact}, {Kind::box}, {Kind::capsule}}) {
    EXPECT_NEAR(height(shape), 0.1, near) << engine_shape_name(shape);
  }
  if (GetParam() != "ode") {
    EXPECT_NEAR(height({Kind::hull, 16}), 0.1, near);
  }
  // Of a single sphere in the middle nothing reaches to the ends: the can sinks to its radius.
  EXPECT_NEAR(height({Kind::spheres, 1}), 0.05, near + 0.006);
}

TEST_P(InEngine, WhatAWorldCannotDoIsRefused) {
  const bool is_mujoco = GetParam() == "mujoco";
  const auto refused = [&](const Scene& scene) -> std::string {
    try {
      check_engine_scene(GetParam(), scene);
      return "";
    } catch (const InvalidInput& e) {
      return e.what();
    }
  };
  Scene loop;
  loop.bodies = {ground(), standing_can()};
  loop.joints = {{.name = "hinge", .kind = JointKind::hinge, .a = 1}};
  EXPECT_EQ(refused(loop), "");
  loop.joints.push_back({.name = "slider", .kind = JointKind::slider, .a = 1, .b = 0});
  Scene belt;
  belt.bodies = {ground(), standing_can()};
  belt.bodies[0].surface_velocity = Vec3(1, 0, 0);
  if (is_mujoco) {
    EXPECT_THAT(refused(loop), HasSubstr("joints[1] is \"slider\""));
    EXPECT_THAT(refused(belt), HasSubstr("no moving surfaces"));
  } else {
    EXPECT_EQ(refused(loop), "");
    EXPECT_EQ(refused(belt), "");
  }
}

TEST_P(InEngine, AGripperGetsAnAnswer) {
  const SceneFile file = read_scene(TOUCHSTONE_SCENES "/gripper.json");
  const EngineChoice choice = choose_in_engine(file, GetParam(), {.trials = {.disturbances = 0}});
  EXPECT_EQ(choice.default_setting().end, "");
  // With our routines every engine carries the can to the shelf, though ODE's solver never lets it
  // rest and MuJoCo's soft fingers sink into it.
  constexpr std::size_t stands = 0, stays_on_shelf = 1;
  ASSERT_EQ(choice.exact_setting().verdicts.size(), file.needs.size());
  EXPECT_TRUE(choice.exact_setting().verdicts[stands].holds());
  EXPECT_TRUE(choice.exact_setting().verdicts[stays_on_shelf].holds());
  EXPECT_EQ(choice.answer.has_value(), GetParam().starts_with("bullet"));
}

TEST_P(InEngine, HasASceneThatNeedsAnotherShapeThanTheDefault) {
  const bool is_bullet = GetParam().starts_with("bullet");
  const SceneFile file = read_scene(is_bullet ? TOUCHSTONE_SCENES "/rod-on-table.json"
                                              : TOUCHSTONE_SCENES "/three-logs.json");
  const EngineChoice choice = choose_in_engine(file, GetParam(), {.trials = {.disturbances = 2}});
  EXPECT_FALSE(choice.default_setting().holds());
  ASSERT_TRUE(choice.answer);
  EXPECT_NE(*choice.answer, 0U);
  const EngineSetting& answer = choice.settings[*choice.answer];
  EXPECT_TRUE(answer.holds());
  EXPECT_EQ(answer.trials, 11U);  // as written, and five times two
  EXPECT_GT(answer.step_seconds.value(), 0);
  for (const EngineSetting& s : choice.settings) {
    const bool is_own = !s.has(Kind::exact) && s.holds();
    if (!is_own) continue;
    EXPECT_FALSE(answer.has(Kind::exact));
    EXPECT_GE(*s.step_seconds, *answer.step_seconds);
  }
}

TEST(EngineChoices, NormalsAreLeftOut) {
  SceneFile file = read_scene(TOUCHSTONE_SCENES "/rod-in-corner.json");
  file.scene.duration = 0.01;
  const EngineChoice choice = choose_in_engine(file, "ode", {.trials = {.disturbances = 0}});
  ASSERT_EQ(choice.left_out.size(), 1U);
  EXPECT_THAT(choice.left_out[0], HasSubstr("normals of rod, floor"));
  EXPECT_EQ(choice.file.needs.size(), file.needs.size() - 1);
}

TEST(EngineChoices, AnUnknownEngineIsNamed) {
  const SceneFile file = read_scene(TOUCHSTONE_SCENES "/three-logs.json");
  EXPECT_THROW(choose_in_engine(file, "unity", {}), InvalidInput);
}

TEST(EngineLines, MakeTheShapeInTheEnginesOwnWords) {
  EXPECT_THAT(engine_lines("bullet", {Kind::no_margin}, can), HasSubstr("setMargin(0)"));
  EXPECT_EQ(engine_lines("bullet", {Kind::capsule}, can), "new btCapsuleShapeZ(0.05, 0.1)");
  EXPECT_EQ(engine_lines("ode", {Kind::capsule}, can), "dCreateCapsule(space, 0.05, 0.1);");
  EXPECT_EQ(engine_lines("mujoco", {Kind::capsule}, can),
            R"(<geom type="capsule" size="0.05 0.05"/>)");
  EXPECT_THAT(engine_lines("mujoco", {Kind::multipoint}, can), HasSubstr("multiccd"));
}

}  // namespace
}  // namespace touchstone
