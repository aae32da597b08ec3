// Robots and worlds as scenes: their bodies, joints, motors and ground.
#include <cmath>
#include <gmock/gmock.h>

#include "reference/error_of_test.hpp"
#include "simulation/assembly.hpp"
#include "simulation/scenes/exact_motion.hpp"
#include "simulation/scenes/robot_files_fixture.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

const Body& body(const Scene& scene, const std::string& name) {
  return by_name(scene.bodies, name);
}
int index(const Scene& scene, const std::string& name) {
  return static_cast<int>(&body(scene, name) - scene.bodies.data());
}
const Joint& joint(const Scene& scene, const std::string& name) {
  return by_name(scene.joints, name);
}

Link ball(const std::string& name, const Vec3& position, double radius = 0.1) {
  Link link{name, Pose(position)};
  link.shapes.push_back({name, Sphere(radius), Pose(position)});
  return link;
}
/// A fixed joint.
LinkJoint weld(const std::string& name, int parent, int child) {
  LinkJoint made;
  made.name = name;
  made.parent = parent;
  made.child = child;
  return made;
}
LinkJoint hinge(const std::string& name, int parent, int child) {
  LinkJoint made = weld(name, parent, child);
  made.kind = JointKind::hinge;
  made.lower = -infinity;
  made.upper = infinity;
  return made;
}
/// Two balls of 2 kg in all, half a metre apart, and a hinge between them.
RobotFile two_balls() {
  RobotFile robot;
  robot.name = "balls";
  robot.links = {ball("a", Vec3(0, 0, 1)), ball("b", Vec3(0.5, 0, 1.2))};
  for (Link& link : robot.links) link.mass = 1;
  robot.joints = {hinge("elbow", 0, 1)};
  return robot;
}

/// Why a scene of the robot is refused.
std::string robot_refusal(const RobotFile& robot, const RobotMotion& motion = {}) {
  return error_text_of([&] { robot_scene(robot, motion); });
}

TEST(RobotScene, StandsOnAGroundThatItTouchesWithItsLowestPoint) {
  const Scene scene = robot_scene(two_balls(), {}).scene;
  const Body& ground = body(scene, "ground");
  EXPECT_TRUE(ground.fixed);
  EXPECT_NEAR(std::get<Plane>(ground.shape).displacement(), 0.9, 1e-15);
}

TEST(RobotScene, AWorldHasNoGroundButItsOwn) {
  RobotFile world = two_balls();
  world.is_world = true;
  EXPECT_EQ(robot_scene(world, {}).scene.bodies.size(), 2U);
  RobotFile robot = two_balls();
  Link floor{"floor"};
  floor.fixed = true;
  floor.shapes.push_back({"floor", Plane(Vec3::UnitZ(), 0), Pose()});
  robot.links.push_back(floor);
  EXPECT_EQ(robot_scene(robot, {}).scene.bodies.size(), 3U);
}

TEST(RobotScene, ALinksMassIsSpreadOverItsShapesByTheirVolume) {
  RobotFile robot = two_balls();
  Link& link = robot.links[0];
  link.mass = 9;
  link.shapes.push_back({"small", Sphere(0.05), Pose(Vec3(0, 0, 2))});
  const Scene scene = robot_scene(robot, {}).scene;
  const double large = inertia(body(scene, "a").shape, body(scene, "a").density).inertia.mass;
  const double small =
      inertia(body(scene, "small").shape, body(scene, "small").density).inertia.mass;
  EXPECT_NEAR(large, 8, 1e-12);
  EXPECT_NEAR(small, 1, 1e-12);
  const Joint& both = joint(scene, "small in a");
  EXPECT_EQ(both.kind, JointKind::fixed);
  robot.links[0].mass = 0;
  EXPECT_EQ(body(robot_scene(robot, {}).scene, "a").density, 1000);
}

TEST(RobotScene, AJointHoldsByItsEffortOrByTheRobotsWeight) {
  RobotFile robot = two_balls();
  robot.joints[0].effort = 7;
  const auto motor = [&] { return joint(robot_scene(robot, {}).scene, "elbow").motor.value(); };
  EXPECT_EQ(motor().target, Motor::Target::position);
  EXPECT_EQ(motor().target_at(1), 0);
  EXPECT_EQ(motor().max_force, 7);
  robot.joints[0].effort.reset();
  // 2 kg, and the diagonal of 0.7 × 0.2 × 0.4 m.
  EXPECT_NEAR(motor().max_force, 2 * 9.81 * std::sqrt(0.49 + 0.04 + 0.16), 1e-9);
  robot.joints[0].effort = 1e300;
  EXPECT_EQ(motor().max_force, 1e9);
  robot.joints[0].holds = false;
  EXPECT_FALSE(joint(robot_scene(robot, {}).scene, "elbow").motor);
}

TEST(RobotScene, AJointIsDrivenOrLooseByOption) {
  const Scene scene = robot_scene(two_balls(), {.rates = {{"elbow", -3}}}).scene;
  const Motor driven = joint(scene, "elbow").motor.value();
  EXPECT_EQ(driven.target, Motor::Target::rate);
  EXPECT_EQ(driven.target_at(0), 0);
  EXPECT_EQ(driven.target_at(1), -3);
  EXPECT_FALSE(joint(robot_scene(two_balls(), {.loose = {"elbow"}}).scene, "elbow").motor);
}

/// A link with a shape and a hinge without limits about y through its centre, of a robot.
void add_wheel(RobotFile& robot, const std::string& name, const Shape& shape, const Pose& pose,
               const Vec3& axis = Vec3::UnitY()) {
  Link link{name, pose};
  link.shapes.push_back({name, shape, pose});
  robot.links.push_back(link);
  robot.joints.push_back(hinge(name, 0, static_cast<int>(robot.links.size()) - 1));
  robot.joints.back().anchor = pose.position();
  robot.joints.back().axis = axis;
}

/// A base and wheels of 0.1 and 0.05 m about y, of which the second one's joint is the other way
/// round.
RobotFile wheeled() {
  RobotFile robot;
  robot.name = "wheeled";
  robot.links = {{"base", Pose(Vec3(0, 0, 0.2))}};
  robot.links[0].shapes.push_back({"base", Box(Vec3(0.2, 0.1, 0.05)), Pose(Vec3(0, 0, 0.2))});
  const Eigen::Quaterniond across = turn_between(Vec3::UnitZ(), Vec3::UnitY());
  add_wheel(robot, "large", Cylinder(0.1, 0.02), Pose(Vec3(0, 0.2, 0.1), across));
  add_wheel(robot, "small", Sphere(0.05), Pose(Vec3(0.2, 0, 0.05)), -Vec3::UnitY());
  return robot;
}

TEST(RollingRates, AreThoseOfWheelsAloneAllTheSameWay) {
  RobotFile robot = wheeled();
  const auto rates = rolling_rates(robot);
  ASSERT_EQ(rates.size(), 2U);
  EXPECT_EQ(rates[0].first, "large");
  EXPECT_EQ(rates[1].first, "small");
  EXPECT_GT(rates[0].second, 0);
  EXPECT_NEAR(rates[1].second, -2 * rates[0].second, 1e-12);  // the same speed of their rims

  const auto names = [&] {
    std::vector<std::string> result;
    for (const auto& [name, rate] : rolling_rates(robot)) result.push_back(name);
    return result;
  };
  // A lidar that spins upright, a crank that is off its axis, a box, an arm with limits.
  add_wheel(robot, "lidar", Cylinder(0.03, 0.02), Pose(Vec3(0, 0, 0.3)), Vec3::UnitZ());
  add_wheel(robot, "crank", Sphere(0.02), Pose(Vec3(0, 0, 0.4)));
  robot.joints.back().anchor = Vec3(0.1, 0, 0.4);
  add_wheel(robot, "paddle", Box(Vec3(0.1, 0.1, 0.1)), Pose(Vec3(0, 0, 0.4)));
  add_wheel(robot, "arm", Cylinder(0.02, 0.2), Pose(Vec3(0, 0.4, 0.4)));
  add_wheel(robot, "limited", Sphere(0.02), Pose(Vec3(0, 0, 0.4)));
  robot.joints.back().upper = 3;
  EXPECT_THAT(names(), testing::ElementsAre("large", "small"));
  robot.joints[0].holds = false;  // what no motor drives, as in MJCF
  EXPECT_THAT(names(), testing::ElementsAre("small"));
  EXPECT_TRUE(rolling_rates(read_robot(scenes / "gripper.urdf")).empty());
}

TEST(RollingRates, RollARobotForwardAndItsDescriptionSaysSo) {
  const RobotFile robot = read_robot(scenes / "rover.urdf");
  RobotMotion motion;
  EXPECT_THAT(robot_scene(robot, motion).description,
              HasSubstr("; no joint is driven, and what rests needs little: see --drive, of "
                        "front_left_wheel_joint, "));
  motion.rates = rolling_rates(robot);
  EXPECT_EQ(motion.rates.size(), 4U);
  const SceneFile file = robot_scene(robot, motion);
  EXPECT_THAT(file.description, HasSubstr("; driven: front_left_wheel_joint=3.14159, "));
  const ExactMotion exact = exact_motion(file.scene, {0, 1}, 1, {}, file.name);
  // Two seconds, less two tenths of start-up on the average of half the rate, at a radius of 0.1 m.
  EXPECT_NEAR(exact.ways[index(file.scene, "chassis")], 3.14159 * 0.1 * 1.9, 0.03);
}

TEST(RobotScene, TheRootIsHeldByOptionWhicheverLinkIsListedFirst) {
  RobotFile robot = two_balls();
  const auto held = [&](bool has_fixed_base) {
    const Scene scene = robot_scene(robot, {.has_fixed_base = has_fixed_base}).scene;
    return std::pair(body(scene, "a").fixed, body(scene, "b").fixed);
  };
  EXPECT_EQ(held(false), std::pair(false, false));
  EXPECT_EQ(held(true), std::pair(true, false));
  std::swap(robot.joints[0].parent, robot.joints[0].child);
  EXPECT_EQ(held(true), std::pair(false, true));
}

TEST(RobotScene, TheRootOfTheOnlyRobotOfAWorldIsHeld) {
  RobotFile world = two_balls();
  world.is_world = true;
  world.links.insert(world.links.begin(), ball("barrel", Vec3(9, 9, 1)));
  world.joints = {hinge("elbow", 1, 2)};
  RobotMotion motion;
  motion.has_fixed_base = true;
  const Scene scene = robot_scene(world, motion).scene;
  EXPECT_TRUE(body(scene, "a").fixed);
  EXPECT_FALSE(body(scene, "b").fixed);
  EXPECT_FALSE(body(scene, "barrel").fixed);

  world.links.push_back(ball("c", Vec3(5, 0, 1)));
  world.links.push_back(ball("d", Vec3(6, 0, 1)));
  world.joints.push_back(hinge("knee", 3, 4));
  EXPECT_EQ(robot_refusal(world, motion),
            "--fixed-base is given: must not be: 2 robots move freely, with the bases "
            "a, c; it holds that of one alone");
  world.joints.push_back(hinge("hip", world_body, 3));
  EXPECT_EQ(robot_refusal(world, motion), "accepted") << "the second robot hangs on the world";
  world.joints.push_back(hinge("waist", world_body, 1));
  EXPECT_THAT(robot_refusal(world, motion), HasSubstr("no robot here moves freely"));
}

TEST(RobotScene, ALengthOfTooManyStepsOrOfNoneIsRefused) {
  RobotFile robot = two_balls();
  robot.step = 1e-6;
  EXPECT_THAT(robot_refusal(robot), HasSubstr("--duration is 2: must be shorter"));
  EXPECT_THAT(robot_refusal(two_balls(), {.duration = 1e-3}),
              HasSubstr("--duration is 0.001: must be at least one step"));
}

TEST(RobotScene, AJointThatIsNotThereIsRefusedWithTheNearestNames) {
  RobotFile robot = two_balls();
  robot.links.push_back(ball("c", Vec3(1, 0, 1)));
  robot.joints.push_back(hinge("left_wheel", 0, 2));
  EXPECT_EQ(robot_refusal(robot, {.rates = {{"left_whel", 1}}}),
            "--drive is \"left_whel\": must be a joint that moves, as left_wheel, elbow");
  for (Link& link : robot.links) link.fixed = true;
  EXPECT_THAT(robot_refusal(robot, {.rates = {{"elbow", 1}}}), HasSubstr("there is none"));
}

TEST(RobotScene, LimitsHoldTheDefaultPosition) {
  RobotFile robot = two_balls();
  robot.joints[0].lower = 0.5;
  robot.joints[0].upper = 2;
  const Joint elbow = joint(robot_scene(robot, {}).scene, "elbow");
  EXPECT_EQ(elbow.lower, 0);
  EXPECT_EQ(elbow.upper, 2);
}

TEST(RobotScene, AJointToSomethingFixedCountsTheSameWay) {
  RobotFile robot = two_balls();
  robot.links[1].fixed = true;
  robot.joints[0].lower = -1;
  robot.joints[0].upper = 2;
  const Scene scene = robot_scene(robot, {}).scene;
  const Joint& elbow = joint(scene, "elbow");
  EXPECT_EQ(elbow.a, index(scene, "a"));  // the parent, which moves the other way
  EXPECT_EQ(elbow.b, index(scene, "b"));
  EXPECT_EQ(elbow.axis, Vec3(-Vec3::UnitZ()));
}

TEST(RobotScene, ALinkWithoutShapesIsABallThatTouchesNothing) {
  RobotFile robot = two_balls();
  robot.links.push_back({"knuckle", Pose(Vec3(0.2, 0, 1))});
  robot.joints = {hinge("steer", 0, 2), hinge("roll", 2, 1)};
  const auto ghost = [&] { return body(robot_scene(robot, {}).scene, "knuckle"); };
  EXPECT_FALSE(ghost().collides);
  EXPECT_NEAR(inertia(ghost().shape, ghost().density).inertia.mass, 0.02, 1e-12);  // 1% of 2 kg
  robot.links[2].mass = 0.3;
  EXPECT_NEAR(inertia(ghost().shape, ghost().density).inertia.mass, 0.3, 1e-12);
  robot.links[2].mass.reset();
  for (const int light : {0, 1}) robot.links[light].mass = 1e-6;
  EXPECT_NEAR(inertia(ghost().shape, ghost().density).inertia.mass, 2e-8, 1e-16);
}

TEST(RobotScene, FramesHaveNoBodies) {
  RobotFile robot = two_balls();
  robot.links.push_back({"optical_frame"});
  robot.links.push_back({"lens_frame"});
  robot.joints.push_back(weld("mount", 1, 2));
  robot.joints.push_back(weld("lens", 2, 3));
  const Scene scene = robot_scene(robot, {}).scene;
  EXPECT_EQ(scene.bodies.size(), 3U);
  EXPECT_EQ(scene.joints.size(), 1U);
}

TEST(RobotScene, TheWorldHoldsARobotThroughFrames) {
  // world - base_link - base - a, as arms are described; or the first of them is held by option.
  RobotFile robot = two_balls();
  robot.links.push_back({"world"});
  robot.links.push_back({"base_link"});
  robot.links.push_back({"base"});
  robot.joints.push_back(weld("bolt", 2, 3));
  robot.joints.push_back(weld("mount", 3, 4));
  robot.joints.push_back(weld("foot", 4, 0));
  EXPECT_TRUE(moved_by_forces(robot_scene(robot, {}).scene)[0]);
  const Scene by_option = robot_scene(robot, {.has_fixed_base = true}).scene;
  EXPECT_FALSE(moved_by_forces(by_option)[index(by_option, "a")]);
  EXPECT_TRUE(moved_by_forces(by_option)[index(by_option, "b")]);
  robot.links[2].fixed = true;
  const Scene bolted = robot_scene(robot, {}).scene;
  EXPECT_FALSE(moved_by_forces(bolted)[index(bolted, "a")]);
  EXPECT_TRUE(moved_by_forces(bolted)[index(bolted, "b")]);
}

TEST(RobotScene, AJointOfTheWorldAndAFrameTurnsWhatStandsOnTheFrame) {
  RobotFile robot = two_balls();
  robot.links.push_back({"world"});
  robot.links.back().fixed = true;
  robot.links.push_back({"plate"});
  robot.joints.push_back(hinge("turntable", 2, 3));
  robot.joints.push_back(weld("foot", 3, 0));
  const Scene scene = robot_scene(robot, {}).scene;
  EXPECT_EQ(joint(scene, "turntable").b, world_body);
  EXPECT_EQ(joint(scene, "foot").a, index(scene, "a"));
}

TEST(RobotScene, LinksThatAJointConnectsDoNotTouchWithAnyShapeAlsoIfOneIsFixed) {
  RobotFile robot = two_balls();
  robot.links[0].shapes.push_back({"bracket", Sphere(0.1), Pose(Vec3(0, 5, 1))});
  for (const bool is_fixed : {false, true}) {
    const Scene scene = robot_scene(robot, {.has_fixed_base = is_fixed}).scene;
    const Touching may(scene);
    EXPECT_FALSE(may(index(scene, "b"), index(scene, "a")));
    EXPECT_FALSE(may(index(scene, "b"), index(scene, "bracket")));
  }
}

TEST(RobotScene, WhatOverlapsAtTheStartNeverTouchesWhateverHoldsTheBase) {
  // Two arms on a base, built into each other.
  RobotFile robot = two_balls();
  robot.links.push_back(ball("c", Vec3(0.6, 0, 1.2)));
  robot.joints.push_back(hinge("other_elbow", 0, 2));
  for (const bool is_fixed : {false, true}) {
    const Scene scene = robot_scene(robot, {.has_fixed_base = is_fixed}).scene;
    EXPECT_FALSE(Touching(scene)(index(scene, "b"), index(scene, "c"))) << is_fixed;
  }
}

TEST(RobotScene, WhatOverlapsAtTheStartNeverTouches) {
  RobotFile robot = two_balls();
  robot.links.push_back(ball("built_in", Vec3(0.15, 0, 1)));
  robot.links.push_back(ball("beside", Vec3(-0.21, 0, 1)));
  robot.joints.push_back(hinge("h", 1, 2));
  robot.joints.push_back(hinge("k", 1, 3));
  const Scene scene = robot_scene(robot, {}).scene;
  const std::pair<int, int> inside{index(scene, "a"), index(scene, "built_in")};
  EXPECT_THAT(scene.apart, testing::ElementsAre(inside));
}

TEST(RobotScene, ARobotOfEllipsoidsAloneIsRefused) {
  RobotFile robot;
  robot.name = "eggs";
  robot.links = {{"base"}};
  robot.left_out.shapes = 1;
  EXPECT_THAT(robot_refusal(robot),
              HasSubstr("not only ellipsoids and height fields: add cylinders"));
}

TEST(RobotScene, ErrorsNameTheLinkIfTheyAreOfOne) {
  RobotFile robot = two_balls();
  robot.gravity = Vec3(0, 0, -1e9);
  EXPECT_THAT(robot_refusal(robot), HasSubstr("gravity[2] is -1000000000"));
  robot = two_balls();
  robot.links[1].mass = 1e30;
  EXPECT_THAT(robot_refusal(robot),
              testing::AllOf(HasSubstr("link b.density is "),
                             HasSubstr("are these in kilograms and metres?")));
}

TEST(RobotNeeds, ABaseWhoseShapesAreNotReadEndsWhereItsWheelsCarryIt) {
  RobotFile robot = two_balls();
  robot.links[1] = ball("b", Vec3(0.5, 0, 1.2), 0.125);
  robot.links.push_back({"base", Pose(Vec3(0.2, 0, 1))});
  robot.links.back().mass = 5;
  robot.joints = {hinge("left", 2, 0), hinge("right", 2, 1)};
  SceneFile file = robot_scene(robot, {});
  const std::vector<double> nothing(file.scene.bodies.size());
  add_robot_needs(file, {nothing, nothing});
  ASSERT_EQ(file.needs.size(), 1U);
  // 5% of the width of the larger wheel, 0.25 m.
  EXPECT_EQ(file.needs[0]->text(file.scene), "base ends within 0.013 m of the exact place");
}

// A can that comes to stand must not come to lie, on whatever place; a ball has no tilt.
TEST(RobotNeeds, WhatNoJointHoldsEndsAsTilted) {
  RobotFile world = two_balls();
  world.is_world = true;
  world.joints.clear();
  world.links[0].shapes[0].shape = Cylinder(0.1, 0.1);
  SceneFile file = robot_scene(world, {});
  const std::vector<double> nothing(file.scene.bodies.size());
  add_robot_needs(file, {nothing, nothing});
  std::vector<std::string> texts;
  for (const auto& need : file.needs) texts.push_back(need->text(file.scene));
  const auto near = [](const char* name) {
    return testing::AllOf(testing::StartsWith(name), testing::EndsWith(" m of the exact place"));
  };
  EXPECT_THAT(texts,
              testing::ElementsAre(near("a "), "a ends within 1° of the exact tilt", near("b ")));
}

TEST(RobotScene, SaysWhatOfTheFileWasNotRead) {
  const RobotFile robot = read_robot(scenes / "gripper.urdf");
  ASSERT_FALSE(robot.ignored.empty());
  EXPECT_EQ(robot_scene(robot, {}).ignored, robot.ignored);
}

}  // namespace
}  // namespace touchstone
