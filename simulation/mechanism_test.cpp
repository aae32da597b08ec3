#include "simulation/mechanism.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "simulation/assembly.hpp"
#include "simulation/kinematic_tree.hpp"
#include "simulation/mechanism_scenes.hpp"

namespace touchstone {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

Eigen::Quaterniond about_z(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}

TEST(DriveTest, SteadyMotionMovesAndTurnsWithTime) {
  const SteadyMotion m{Vec3(1, 2, 3), Vec3(0, 0, 0.5)};
  const Pose pose = driven_pose(m, Pose(Vec3(1, 0, 0), about_z(0.25)), 2);
  EXPECT_TRUE(pose.position().isApprox(Vec3(3, 4, 6)));
  EXPECT_NEAR(angle_about_z(pose), 1.25, 1e-15);
}

TEST(DriveTest, OscillationIsBackAfterHalfAPeriodAndFarthestAfterAQuarter) {
  const Oscillation o{Vec3(0.1, 0, 0), Vec3(0, 0, 0.2), 5};
  EXPECT_LT((driven_pose(o, at(1, 1, 1), 0.1).position() - Vec3(1, 1, 1)).norm(), 1e-15);
  const Pose farthest = driven_pose(o, at(1, 1, 1), 0.05);
  EXPECT_LT((farthest.position() - Vec3(1.1, 1, 1)).norm(), 1e-15);
  EXPECT_NEAR(angle_about_z(farthest), 0.2, 1e-15);
}

TEST(DriveTest, WaypointsAreVisitedAtTheirTimesAtRestAndTheLastIsKept) {
  const Drive drive = Waypoints{{1, at(0, 0, 1)}, {3, Pose(Vec3(2, 0, 1), about_z(1))}};
  const Pose start = at(0, 0, 0);
  EXPECT_EQ(driven_pose(drive, start, 0).position(), Vec3(0, 0, 0));
  EXPECT_EQ(driven_pose(drive, start, 1).position(), Vec3(0, 0, 1));
  EXPECT_LT((driven_pose(drive, start, 2).position() - Vec3(1, 0, 1)).norm(), 1e-15);
  EXPECT_NEAR(angle_about_z(driven_pose(drive, start, 2)), 0.5, 1e-15);
  EXPECT_EQ(driven_pose(drive, start, 9).position(), Vec3(2, 0, 1));
  const double h = 1e-4;
  for (const double time : {h / 2, 1 + h / 2, 3 + h / 2}) {
    EXPECT_LT(driven_state(drive, start, time, h).velocity.norm(), 3 * h) << time;
  }
  // 3s² − 2s³ has the slope 1.5 half way.
  EXPECT_NEAR(driven_state(drive, start, 2 + h / 2, h).velocity.x(), 1.5, 1e-6);
  EXPECT_NEAR(driven_state(drive, start, 2 + h / 2, h).angular_velocity.z(), 0.75, 1e-6);
}

TEST(DriveTest, VelocitiesOfAStepLeadFromOnePoseToTheNext) {
  const Drive drive = SteadyMotion{Vec3(1, -1, 0.5), Vec3(-3, 1, 2)};
  const double h = 1.0 / 240;
  const BodyState state = driven_state(drive, Pose(), 0.5, h);
  EXPECT_LT((state.velocity - Vec3(1, -1, 0.5)).norm(), 1e-12);
  EXPECT_LT((state.angular_velocity - Vec3(-3, 1, 2)).norm(), 1e-11);
}

TEST(DriveTest, WhatTurnsByMoreThanHalfATurnInAStepKeepsItsSense) {
  const double h = 1.0 / 240;
  const Vec3 spin(0, -600, 800);  // 4.2 rad in a step
  EXPECT_LT(
      (driven_state(SteadyMotion{.angular_velocity = spin}, Pose(), 0.5, h).angular_velocity - spin)
          .norm(),
      1e-9);
  const Oscillation o{.turn = Vec3(0, 0, 40), .frequency = 5};
  const double rate = 40 * std::sin(2 * pi * 5 * h) / h;  // in the first step, by 5.2 rad
  EXPECT_NEAR(driven_state(o, Pose(), h, h).angular_velocity.z(), rate, 1e-9);
}

TEST(MotorTest, TargetsAreLinearBetweenTheirTimes) {
  const Motor motor{Motor::Target::rate, {{1, 2}, {3, 6}}, 1};
  EXPECT_EQ(motor.target_at(0), 2);
  EXPECT_EQ(motor.target_at(2), 4);
  EXPECT_EQ(motor.target_at(3), 6);
  EXPECT_EQ(motor.target_at(99), 6);
}

TEST(AssemblyTest, TwoHalvesOfABoxAreTheBox) {
  Scene scene;
  const Pose middle(Vec3(1, 2, 3), Eigen::Quaterniond(0.5, 0.1, -0.7, 0.3));
  for (const double side : {-1.0, 1.0}) {
    const Vec3 centre = middle.position() + middle.rotation() * Vec3(side * 0.3, 0, 0);
    scene.bodies.push_back(
        box(side < 0 ? "left" : "right", Vec3(0.3, 0.2, 0.1), {centre, middle.orientation()}));
  }
  scene.joints = {rigid(1, 0)};
  const auto all = assemblies(scene);
  ASSERT_EQ(all.size(), 1);
  const Inertia whole = inertia(Box(Vec3(0.6, 0.2, 0.1)), 1000).inertia;
  EXPECT_NEAR(all[0].inertia.mass, whole.mass, 1e-12 * whole.mass);
  EXPECT_LT((all[0].X_WF.position() - middle.position()).norm(), 1e-15);
  const Eigen::Matrix3d axes = all[0].X_WF.rotation();
  const Eigen::Matrix3d expected =
      middle.rotation() * whole.principal.asDiagonal() * middle.rotation().transpose();
  EXPECT_LT((axes * all[0].inertia.principal.asDiagonal() * axes.transpose() - expected).norm(),
            1e-12 * whole.principal.norm());
  for (int b = 0; b < 2; ++b) {
    const BodyState state = state_within({all[0].X_WF, Vec3::Zero(), Vec3::Zero()}, all[0].X_FB[b]);
    EXPECT_LT((state.pose.position() - scene.bodies[b].pose.position()).norm(), 1e-15);
    EXPECT_LT((state.pose.rotation() - scene.bodies[b].pose.rotation()).norm(), 1e-14);
  }
}

/// Boxes of these names, all in one place.
Scene boxes(std::initializer_list<const char*> names) {
  Scene scene;
  for (const char* name : names) {
    scene.bodies.push_back(box(name, Vec3::Constant(0.1), at(0, 0, 0)));
  }
  return scene;
}

TEST(AssemblyTest, AJointToTheWorldOrAFixedBodyFixesAllThatHangsOnIt) {
  Scene scene = boxes({"a", "b", "c", "d"});
  scene.bodies[3].fixed = true;
  scene.joints = {rigid(0, world_body), rigid(1, 0), rigid(2, 3)};
  for (const Assembly& a : assemblies(scene)) EXPECT_TRUE(a.fixed);
}

TEST(CheckSceneTest, RefusesJointsWithinWhatIsRigid) {
  Scene scene = boxes({"arm", "wrist", "hand"});
  const Joint slide = {"slide", JointKind::slider, 2, 0};
  scene.joints = {rigid(0, 1), slide, rigid(1, 2)};
  EXPECT_THAT(refusal_of(scene),
              HasSubstr("joints[1] is a slider of hand and arm: must join what can "
                        "move apart: fixed joints make these bodies one"));
  scene.joints.pop_back();
  EXPECT_EQ(refusal_of(scene), "accepted");
}

TEST(CheckSceneTest, RefusesJointsOfWhatNoForceMoves) {
  Scene scene = boxes({"base", "column", "belt"});
  scene.bodies[0].fixed = true;
  scene.bodies[2].drive = SteadyMotion{};
  const Joint to_world = hinge(1, world_body, Vec3::Zero(), Vec3::UnitZ());
  scene.joints = {rigid(1, world_body), to_world};
  EXPECT_THAT(refusal_of(scene),
              HasSubstr("joints[1] is a hinge of column and the world: must join "
                        "something that forces move"));
  for (const auto& [a, b] : {std::pair{2, 0}, {1, 0}, {2, 1}}) {
    scene.joints[1] = hinge(a, b, Vec3::Zero(), Vec3::UnitZ());
    EXPECT_THAT(refusal_of(scene), HasSubstr("these are fixed or driven")) << a << b;
  }
  scene.joints = {to_world};
  EXPECT_EQ(refusal_of(scene), "accepted");
}

TEST(TouchingTest, JoinedUnmovedAndUncollidingBodiesDoNot) {
  Scene scene = boxes({"ground", "chassis", "mast", "wheel", "road", "ghost", "can"});
  enum { ground, chassis, mast, wheel, road, ghost, can };
  scene.bodies[ground].fixed = true;
  scene.bodies[road].drive = SteadyMotion{};
  scene.bodies[ghost].collides = false;
  scene.joints = {rigid(mast, chassis), hinge(wheel, chassis, Vec3::Zero(), Vec3::UnitY())};
  const Touching may(scene);
  EXPECT_FALSE(may(mast, chassis));
  EXPECT_FALSE(may(wheel, chassis));
  EXPECT_FALSE(may(mast, wheel)) << "the mast is part of the chassis";
  EXPECT_FALSE(may(ground, road));
  EXPECT_FALSE(may(ghost, can));
  EXPECT_FALSE(may(can, can));
  EXPECT_TRUE(may(wheel, ground));
  EXPECT_TRUE(may(ground, wheel));
  EXPECT_TRUE(may(can, road));
  EXPECT_TRUE(may(can, mast));
}

TEST(TouchingTest, WhatAFixedJointMakesOneIsOneWhereTheWorldHoldsItToo) {
  enum { tower, block, rod };
  for (const bool is_fixed : {false, true}) {
    Scene scene = boxes({"tower", "block", "rod"});
    scene.bodies[tower].fixed = is_fixed;
    scene.joints = {hinge(rod, tower, Vec3::Zero(), Vec3::UnitY()), rigid(block, tower)};
    if (!is_fixed) scene.joints.push_back(rigid(tower, world_body));
    const Touching may(scene);
    EXPECT_FALSE(may(rod, tower));
    EXPECT_FALSE(may(rod, block));
  }
}

TEST(CheckSceneTest, RefusesPushesAndVelocitiesThatHaveNoEffect) {
  Scene scene = boxes({"floor", "lamp", "table", "cup", "can"});
  scene.bodies[0].fixed = true;
  scene.bodies[2].drive = SteadyMotion{};
  scene.joints = {rigid(1, world_body), rigid(3, 2)};
  for (int b = 0; b < 4; ++b) {
    scene.pushes = {{.body = b, .force = Vec3(1, 0, 0)}};
    EXPECT_THAT(refusal_of(scene), HasSubstr("pushes[0].body is \"" + scene.bodies[b].name +
                                             "\": must be moved by forces"));
  }
  scene.pushes[0].body = 4;
  EXPECT_EQ(refusal_of(scene), "accepted");
  Scene moving = scene;
  moving.bodies[1].velocity = Vec3(1, 0, 0);
  EXPECT_THAT(refusal_of(moving),
              HasSubstr("bodies[1].velocity is not zero: must be zero, for fixed "
                        "joints make lamp one with what is fixed"));
  moving = scene;
  moving.bodies[3].angular_velocity = Vec3(1, 0, 0);
  EXPECT_THAT(refusal_of(moving),
              HasSubstr("bodies[3].angular_velocity is not zero: must be zero, for "
                        "fixed joints make cup one with table, which is driven"));
}

Joint bare_hinge(int a, int b) { return {"hinge", JointKind::hinge, a, b}; }

Scene boxes(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    scene.bodies.push_back({.name = std::to_string(i), .shape = Box(Vec3(1, 1, 1))});
  }
  return scene;
}

std::vector<Hanging> tree_of(const Scene& scene) {
  return kinematic_tree(scene, assemblies(scene));
}

TEST(KinematicTree, WheelsHangOnTheChassisWhereverItStands) {
  Scene scene = boxes(3);
  scene.joints = {bare_hinge(0, 1), bare_hinge(2, 1)};
  const auto tree = tree_of(scene);
  EXPECT_EQ(tree[1].joint, -1);
  EXPECT_EQ(tree[0].parent, 1);
  EXPECT_EQ(tree[0].joint, 0);
  EXPECT_EQ(tree[2].joint, 1);
  EXPECT_EQ(tree[1].children, (std::vector<int>{0, 2}));
  EXPECT_FALSE(loop_closing_joint(scene));
}

TEST(KinematicTree, AChainHangsOnWhatHoldsIt) {
  for (const bool is_driven : {false, true}) {
    Scene scene = boxes(3);
    scene.bodies[0].fixed = !is_driven;
    if (is_driven) scene.bodies[0].drive = SteadyMotion{};
    scene.joints = {bare_hinge(1, 2), bare_hinge(0, 1)};
    const auto tree = tree_of(scene);
    EXPECT_EQ(tree[0].joint, -1);
    EXPECT_EQ(tree[1].joint, 1);
    EXPECT_EQ(tree[1].parent, is_driven ? 0 : -1);
    EXPECT_EQ(tree[2].parent, 1);
  }
}

TEST(KinematicTree, APairThatHangsOnEachOtherTwiceClosesALoop) {
  Scene scene = boxes(3);
  scene.joints = {bare_hinge(0, 1), bare_hinge(1, 2), bare_hinge(2, 0)};
  EXPECT_EQ(loop_closing_joint(scene), 2);
  scene.joints = {bare_hinge(0, 1), bare_hinge(1, 0)};
  EXPECT_EQ(loop_closing_joint(scene), 1);
}

TEST(KinematicTree, WhatIsFixedOrDrivenClosesALoopToo) {
  Scene scene = boxes(3);
  scene.bodies[1].fixed = true;
  scene.joints = {bare_hinge(0, world_body), bare_hinge(0, 1)};
  EXPECT_EQ(loop_closing_joint(scene), 1);
  scene.bodies[2].drive = SteadyMotion{};
  scene.joints = {bare_hinge(0, 2), bare_hinge(0, 1)};
  EXPECT_EQ(loop_closing_joint(scene), 1);
  scene.joints = {bare_hinge(1, world_body), bare_hinge(2, 1), bare_hinge(2, world_body)};
  EXPECT_FALSE(loop_closing_joint(scene)) << "none of these joints moves anything";
}

TEST(KinematicTree, RigidlyJoinedBodiesAreOne) {
  Scene scene = boxes(3);
  scene.joints = {{"rigid", JointKind::fixed, 0, 1}, bare_hinge(2, 0), bare_hinge(2, 1)};
  EXPECT_EQ(tree_of(scene).size(), 2);
  EXPECT_EQ(loop_closing_joint(scene), 2);
}

}  // namespace
}  // namespace touchstone
