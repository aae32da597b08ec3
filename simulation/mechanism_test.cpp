#include "simulation/mechanism.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <numbers>
#include <tuple>

#include "reference/invalid_input.hpp"
#include "simulation/assembly.hpp"
#include "simulation/mechanism_scenes.hpp"
#include "simulation/world_fixture.hpp"

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
  const Inertia whole = inertia(Box(Vec3(0.6, 0.2, 0.1)), 1000);
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

TEST(AssemblyTest, AJointToTheWorldOrAFixedBodyFixesAllThatHangsOnIt) {
  Scene scene;
  for (const char* name : {"a", "b", "c", "d"}) {
    scene.bodies.push_back(box(name, Vec3::Constant(0.1), at(0, 0, 0)));
  }
  scene.bodies[3].fixed = true;
  scene.joints = {rigid(0, world_body), rigid(1, 0), rigid(2, 3)};
  for (const Assembly& a : assemblies(scene)) EXPECT_TRUE(a.fixed);
}

/// What check_scene says of a scene; empty if it accepts it.
std::string refusal(const Scene& scene) {
  try {
    check_scene(scene);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

TEST(CheckSceneTest, RefusesJointsWithinWhatIsRigid) {
  Scene scene;
  for (const char* name : {"arm", "wrist", "hand"}) {
    scene.bodies.push_back(box(name, Vec3::Constant(0.1), at(0, 0, 0)));
  }
  const Joint slide = {"slide", JointKind::slider, 2, 0};
  scene.joints = {rigid(0, 1), slide, rigid(1, 2)};
  EXPECT_THAT(refusal(scene), HasSubstr("joints[1] is a slider of hand and arm: must join what can "
                                        "move apart: fixed joints make these bodies one"));
  scene.joints.pop_back();
  EXPECT_EQ(refusal(scene), "");
}

TEST(CheckSceneTest, RefusesJointsOfWhatNoForceMoves) {
  Scene scene;
  for (const char* name : {"base", "column", "belt"}) {
    scene.bodies.push_back(box(name, Vec3::Constant(0.1), at(0, 0, 0)));
  }
  scene.bodies[0].fixed = true;
  scene.bodies[2].drive = SteadyMotion{};
  const Joint to_world = hinge(1, world_body, Vec3::Zero(), Vec3::UnitZ());
  scene.joints = {rigid(1, world_body), to_world};
  EXPECT_THAT(refusal(scene), HasSubstr("joints[1] is a hinge of column and the world: must join "
                                        "something that forces move"));
  for (const auto& [a, b] : {std::pair{2, 0}, {1, 0}, {2, 1}}) {
    scene.joints[1] = hinge(a, b, Vec3::Zero(), Vec3::UnitZ());
    EXPECT_THAT(refusal(scene), HasSubstr("these are fixed or driven")) << a << b;
  }
  scene.joints = {to_world};
  EXPECT_EQ(refusal(scene), "");
}

TEST(TouchingTest, JoinedUnmovedAndUncollidingBodiesDoNot) {
  Scene scene;
  for (const char* name : {"ground", "chassis", "mast", "wheel", "road", "ghost", "can"}) {
    scene.bodies.push_back(box(name, Vec3::Constant(0.1), at(0, 0, 0)));
  }
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
    Scene scene;
    for (const char* name : {"tower", "block", "rod"}) {
      scene.bodies.push_back(box(name, Vec3::Constant(0.1), at(0, 0, 0)));
    }
    scene.bodies[tower].fixed = is_fixed;
    scene.joints = {hinge(rod, tower, Vec3::Zero(), Vec3::UnitY()), rigid(block, tower)};
    if (!is_fixed) scene.joints.push_back(rigid(tower, world_body));
    const Touching may(scene);
    EXPECT_FALSE(may(rod, tower));
    EXPECT_FALSE(may(rod, block));
  }
}

using MechanismTest = WorldFixture;

TEST_F(MechanismTest, AJoinedPairTumblesAsTheBoxThatItIs) {
  const auto [halves, whole] = TumblingBox();
  const World a = run(halves), b = run(whole);
  const Vec3 middle = (a.states()[0].pose.position() + a.states()[1].pose.position()) / 2;
  EXPECT_LT((middle - b.states()[0].pose.position()).norm(), 1e-12);
  const BodyState& spun = b.states()[0];
  for (const BodyState& half : a.states()) {
    const Vec3 arm = half.pose.position() - spun.pose.position();
    EXPECT_LT((half.velocity - spun.velocity - spun.angular_velocity.cross(arm)).norm(), 1e-9);
  }
  EXPECT_LT((a.states()[1].pose.rotation() - b.states()[0].pose.rotation()).norm(), 1e-10);
  EXPECT_LT((a.angular_momentum() - b.angular_momentum()).norm(), 1e-9);
}

// Small swings of a box about a hinge at its upper end: ω² = m g l / I (physical pendulum).
TEST_F(MechanismTest, AHingedBoxSwingsWithThePeriodOfAPhysicalPendulum) {
  Scene scene;
  const double l = 0.5, amplitude = 0.02;
  const Vec3 half(0.05, 0.05, l);
  Body pendulum = box("pendulum", half, Pose());
  pendulum.pose = Pose(Vec3(l * std::sin(amplitude), 0, -l * std::cos(amplitude)),
                       Eigen::Quaterniond(Eigen::AngleAxisd(-amplitude, Vec3::UnitY())));
  scene.bodies = {pendulum};
  scene.joints = {hinge(0, world_body, Vec3::Zero(), Vec3::UnitY())};
  const Inertia i = inertia(pendulum.shape, pendulum.density);
  const double omega = std::sqrt(i.mass * 9.81 * l / (i.principal.y() + i.mass * l * l));
  scene.step = 1.0 / 1000;
  World world(scene, model);
  double crossed = 0;
  for (double before = 1; crossed == 0 && world.time() < 3;) {
    world.step();
    const double x = world.states()[0].pose.position().x();
    if (before > 0 && x <= 0) crossed = world.time();
    before = x;
  }
  EXPECT_NEAR(crossed, pi / 2 / omega, 2e-3);
  EXPECT_NEAR(world.states()[0].pose.position().norm(), l, 1e-5);
}

/// Angle or way of the first of two bodies relative to the second, or to the world if that is null.
struct Driven : MechanismTest {
  double relative(const Scene& scene, const World& world) const {
    const Joint& joint = scene.joints[0];
    const Pose& a = world.states()[joint.a].pose;
    const Pose b = joint.b == world_body ? Pose() : world.states()[joint.b].pose;
    return joint.kind == JointKind::hinge
               ? angle_about_z(a) - angle_about_z(b)
               : a.position().z() - b.position().z() - 1;  // as they start
  }
  /// A motor along or about z between two bodies; either may be fixed, the second the world.
  Scene motor_scene(JointKind kind, bool a_is_fixed, bool b_is_fixed, bool b_is_world) const {
    Scene scene;
    scene.gravity = Vec3::Zero();
    scene.bodies = {box("a", Vec3(0.1, 0.2, 0.1), at(0, 0, 1)),
                    box("b", Vec3(0.2, 0.1, 0.1), at(0, 0, 0))};
    scene.bodies[0].fixed = a_is_fixed;
    scene.bodies[1].fixed = b_is_fixed;
    scene.joints = {{"motor", kind, 0, b_is_world ? world_body : 1, Vec3::Zero(), Vec3::UnitZ()}};
    return scene;
  }
};

TEST_F(Driven, MotorsMoveTheFirstBodyRelativeToTheSecondWhicheverIsFixed) {
  for (const JointKind kind : {JointKind::hinge, JointKind::slider}) {
    for (int fixed = 0; fixed < 4; ++fixed) {
      SCOPED_TRACE(fmt::format("{}, {}", joint_kind_name(kind), fixed));
      Scene scene = motor_scene(kind, fixed == 1, fixed == 2, fixed == 3);
      scene.joints[0].motor = rate(0.5, 1000);
      EXPECT_NEAR(relative(scene, run(scene)), 0.5, 5e-3) << "rate";
      scene.joints[0].motor = position(-0.4, 1000);
      EXPECT_NEAR(relative(scene, run(scene)), -0.4, 1e-5) << "position";
      scene.joints[0].motor = rate(0.5, 1000);
      scene.joints[0].upper = 0.3;
      EXPECT_NEAR(relative(scene, run(scene)), 0.3, 5e-3) << "limit";
    }
  }
}

TEST_F(Driven, HingesKeepTheirLimitsBeyondHalfATurn) {
  for (const auto& limits : far_limits) {
    for (const double speed : {-4.0, 4.0}) {
      for (int fixed = 0; fixed < 4; ++fixed) {
        Scene scene = motor_scene(JointKind::hinge, fixed == 1, fixed == 2, fixed == 3);
        scene.joints[0].motor = rate(speed, 1000);
        std::tie(scene.joints[0].lower, scene.joints[0].upper) = limits;
        World world(scene, model);
        double angle = 0;
        while (world.time() < 2.5) {
          world.step();
          angle = nearest_turn(relative(scene, world), angle);
        }
        EXPECT_NEAR(angle, turned_within(limits, 2.5 * speed), 0.02)
            << limits.first << " to " << limits.second << ", fixed " << fixed;
      }
    }
  }
}

TEST_F(Driven, AMotorFollowsAPositionBeyondHalfATurnTheWayItIsTold) {
  Scene scene = motor_scene(JointKind::hinge, false, true, false);
  scene.joints[0].motor = position(3.6, 1000);
  scene.joints[0].lower = -0.1;
  EXPECT_NEAR(nearest_turn(relative(scene, run(scene)), 3), 3.6, 1e-5);
  scene.joints[0].motor = Motor{Motor::Target::position, {{0, 8.0}}, 1000};
  scene.duration = 2;
  World world(scene, model);
  double angle = 0;
  while (world.time() < 2) {
    world.step();
    angle = nearest_turn(relative(scene, world), angle + 0.5);
  }
  EXPECT_NEAR(angle, 8, 1e-5);
}

TEST_F(Driven, AMotorPushesNoHarderThanItCan) {
  Scene scene = motor_scene(JointKind::slider, false, true, false);
  const double mass = inertia(scene.bodies[0].shape, 1000).mass;
  scene.joints[0].motor = rate(1000, 3 * mass);
  const World world = run(scene);
  EXPECT_NEAR(world.states()[0].velocity.z(), 3, 1e-2);
}

TEST_F(MechanismTest, APushGivesTheMomentumOfItsForceAndTime) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.bodies = {box("a", Vec3::Constant(0.1), Pose())};
  const double mass = inertia(scene.bodies[0].shape, 1000).mass;
  scene.pushes = {{0, Vec3(4 * mass, 0, 0), Vec3::Zero(), 0.25, 0.75}};
  EXPECT_NEAR(run(scene).states()[0].velocity.x(), 2, 1e-12);
  scene.duration = 0.5;
  EXPECT_NEAR(run(scene).states()[0].velocity.x(), 1, 1e-12);
  const Inertia i = inertia(scene.bodies[0].shape, 1000);
  scene.pushes = {{0, Vec3::Zero(), Vec3(0, 0, 3 * i.principal.z()), 0, infinity}};
  EXPECT_NEAR(run(scene).states()[0].angular_velocity.z(), 1.5, 1e-12);
}

TEST_F(MechanismTest, APushHasItsImpulseWhateverTheStep) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.bodies = {box("a", Vec3::Constant(0.1), Pose())};
  const Inertia i = inertia(scene.bodies[0].shape, 1000);
  for (const auto& [from, until] :
       {std::pair{0.1005, 0.1006}, {0.0999, 0.1001}, {0.1234, 0.4321}, {0.25, 0.5}}) {
    scene.pushes = {{0, Vec3(2 * i.mass, 0, 0), Vec3(0, 3 * i.principal.y(), 0), from, until}};
    const World world = run(scene);
    EXPECT_NEAR(world.states()[0].velocity.x(), 2 * (until - from), 1e-12);
    EXPECT_NEAR(world.states()[0].angular_velocity.y(), 3 * (until - from), 1e-12);
  }
}

TEST(CheckSceneTest, RefusesPushesAndVelocitiesThatHaveNoEffect) {
  Scene scene;
  for (const char* name : {"floor", "lamp", "table", "cup", "can"}) {
    scene.bodies.push_back(box(name, Vec3::Constant(0.1), at(0, 0, 0)));
  }
  scene.bodies[0].fixed = true;
  scene.bodies[2].drive = SteadyMotion{};
  scene.joints = {rigid(1, world_body), rigid(3, 2)};
  for (int b = 0; b < 4; ++b) {
    scene.pushes = {{.body = b, .force = Vec3(1, 0, 0)}};
    EXPECT_THAT(refusal(scene), HasSubstr("pushes[0].body is \"" + scene.bodies[b].name +
                                          "\": must be moved by forces"));
  }
  scene.pushes[0].body = 4;
  EXPECT_EQ(refusal(scene), "");
  Scene moving = scene;
  moving.bodies[1].velocity = Vec3(1, 0, 0);
  EXPECT_THAT(refusal(moving), HasSubstr("bodies[1].velocity is not zero: must be zero, for fixed "
                                         "joints make lamp one with what is fixed"));
  moving = scene;
  moving.bodies[3].angular_velocity = Vec3(1, 0, 0);
  EXPECT_THAT(refusal(moving),
              HasSubstr("bodies[3].angular_velocity is not zero: must be zero, for "
                        "fixed joints make cup one with table, which is driven"));
}

TEST_F(MechanismTest, ABeltCarriesWhatLiesOnItWhicheverBodyComesFirst) {
  const Vec3 belt(0.3, 0.1, 0);
  Body belt_body = fixed(box("belt", Vec3(5, 5, 0.1), Pose(Vec3(0, 0, -0.1), about_z(0.7))));
  belt_body.surface_velocity = belt;
  Body can{"can", Cylinder(0.05, 0.02)},
      brick = box("brick", Vec3(0.05, 0.05, 0.02), at(1, 0, 0.02));
  can.pose = at(0, 0, 0.02);
  // A fixed cylinder comes first in its pairs.
  Body drum = fixed({"drum", Cylinder(5, 0.1)});
  drum.pose = Pose(Vec3(0, 0, -0.1), about_z(0.7));
  drum.surface_velocity = belt;
  for (const auto& bodies : {std::vector{belt_body, can, brick},
                             {can, brick, belt_body},
                             {drum, brick},
                             {brick, drum}}) {
    Scene scene;
    scene.bodies = bodies;
    const World world = run(scene);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].fixed) continue;
      EXPECT_LT((world.states()[i].velocity - about_z(0.7) * belt).norm(), 1e-4)
          << bodies[i].name << " after " << bodies.front().name;
    }
  }
}

TEST_F(MechanismTest, ASlipOnABeltIsThatOfCoulombsFriction) {
  Body belt = fixed(box("belt", Vec3(5, 5, 0.1), at(0, 0, -0.1)));
  belt.surface_velocity = Vec3(100, 0, 0);
  Body can{"can", Cylinder(0.05, 0.02)};
  can.pose = at(-4, 0, 0.02);
  belt.material.friction = can.material.friction = 0.3;
  Scene scene;
  scene.bodies = {can, belt};
  scene.duration = 0.5;
  const World world = run(scene);
  EXPECT_NEAR(world.states()[0].velocity.x(), 0.3 * 9.81 * 0.5, 0.02);
}

TEST_F(MechanismTest, ALiftedCanRisesWithItsTable) {
  Body table = box("table", Vec3(0.5, 0.5, 0.05), at(0, 0, -0.05));
  table.drive = Waypoints{{0.5, at(0, 0, 0.25)}, {1, at(0.2, 0, 0.25)}};
  Body can{"can", Cylinder(0.05, 0.1)};
  can.pose = at(0, 0, 0.1);
  Scene scene;
  scene.bodies = {table, can};
  const World world = run(scene);
  EXPECT_LT((world.states()[0].pose.position() - Vec3(0.2, 0, 0.25)).norm(), 1e-15);
  EXPECT_LT((world.states()[1].pose.position() - Vec3(0.2, 0, 0.4)).norm(), 2e-3);
  EXPECT_GT(world.states()[1].pose.axis().z(), 0.9999);
}

TEST_F(MechanismTest, ADrumThatTurnsByMoreThanHalfATurnInAStepDragsTheRightWay) {
  EXPECT_NEAR(run(fast_drum()).states()[1].velocity.x(), 0.5 * 9.81 * 0.1, 0.1);
}

/// Two fingers on a driven hand squeeze a can, and the hand rises by 0.2 m.
Scene squeezing_gripper(double squeeze) {
  Body hand = box("hand", Vec3(0.1, 0.02, 0.02), at(0, 0, 0.3));
  hand.drive = Waypoints{{0.3, at(0, 0, 0.3)}, {1, at(0, 0, 0.5)}};
  Body left = box("left", Vec3(0.01, 0.02, 0.05), at(-0.05, 0, 0.15));
  Body right = box("right", Vec3(0.01, 0.02, 0.05), at(0.05, 0, 0.15));
  Body can{"can", Cylinder(0.03, 0.06), 500};
  can.pose = at(0, 0, 0.15);
  Body table = fixed(box("table", Vec3(0.2, 0.2, 0.045), at(0, 0, 0.045)));
  Scene scene;
  scene.bodies = {hand, left, right, can, table};
  scene.joints = {{"left", JointKind::slider, 1, 0, Vec3::Zero(), Vec3::UnitX()},
                  {"right", JointKind::slider, 2, 0, Vec3::Zero(), -Vec3::UnitX()}};
  for (Joint& joint : scene.joints) joint.motor = rate(0.2, squeeze);
  return scene;
}

TEST_F(MechanismTest, AGripperHoldsACanByFrictionIfItSqueezesHardEnough) {
  // Friction 0.5 at two fingers must carry the weight.
  const double weight = 9.81 * inertia(Cylinder(0.03, 0.06), 500).mass;
  constexpr int can = 3;
  EXPECT_NEAR(run(squeezing_gripper(2 * weight)).states()[can].pose.position().z(), 0.35, 2e-3);
  EXPECT_NEAR(run(squeezing_gripper(0.5 * weight)).states()[can].pose.position().z(), 0.15, 1e-2);
}

}  // namespace
}  // namespace touchstone
