// MJCF: what is read and where, what may touch, and which files are refused.
#include <cmath>
#include <gmock/gmock.h>

#include "simulation/assembly.hpp"
#include "simulation/scenes/robot_files_fixture.hpp"

namespace touchstone {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(Mjcf, SaysWhatOfItsJointsItIgnores) {
  const RobotFile robot = robot_of("joint.xml", R"(<mujoco><worldbody><body>
    <joint name="j" damping="1" frictionloss="2" armature="3" stiffness="4"/><geom size="0.1"/>
    <body pos="1 0 0"><joint name="plain"/><geom size="0.1"/></body></body></worldbody></mujoco>)");
  EXPECT_THAT(robot.ignored, testing::UnorderedElementsAre("damping of joint j: not read",
                                                           "friction of joint j: not read",
                                                           "armature of joint j: not read",
                                                           "the spring of joint j: not read"));
}

TEST(Mjcf, GivesShapesJointsAndActuators) {
  const RobotFile robot = read_robot(scenes / "pincer.xml");
  EXPECT_EQ(robot.name, "pincer");
  EXPECT_EQ(robot.step, 0.004);
  EXPECT_EQ(shape_count(robot), 6U);  // without what collides with nothing
  const LinkShape& pad = named(robot, "left_finger/left_pad");
  EXPECT_EQ(std::get<Cylinder>(pad.shape).half_length(), 0.07);
  EXPECT_NEAR((pad.pose.position() - Vec3(0.06, 0, 0.13)).norm(), 0, 1e-12);
  EXPECT_EQ(pad.friction, 0.9);
  const LinkJoint& left = by_name(robot.joints, "left");
  EXPECT_EQ(left.kind, JointKind::slider);
  EXPECT_EQ(left.upper, 0.06);
  EXPECT_EQ(left.effort, 10);
  EXPECT_TRUE(left.holds);
  EXPECT_EQ(by_name(robot.joints, "lift").effort, 40);
  EXPECT_TRUE(by_name(robot.links, "world").fixed);
  EXPECT_NEAR(*by_name(robot.links, "rod").mass, 0.12, 1e-12);
}

TEST(Mjcf, SaysWhatItIgnoresAndHowMuchThatIs) {
  const RobotFile robot = read_robot(scenes / "pincer.xml");
  EXPECT_THAT(robot.ignored, Contains("1 tendon: not read"));
  EXPECT_THAT(robot.ignored, Contains("1 sensor: not read"));
  EXPECT_THAT(robot.ignored, Contains("1 site: not read"));
  const RobotFile egg = robot_of("egg.xml", R"(<mujoco><worldbody><body>
    <geom type="ellipsoid" size="0.1 0.2 0.3"/><geom size="0.1"/></body></worldbody></mujoco>)");
  EXPECT_THAT(egg.ignored, Contains("geom body 1/geom 0: an ellipsoid"));
  EXPECT_EQ(left_out_text(egg), "left out: 1 of 2 collision shapes (86% of the volume)");
}

TEST(Mjcf, ABodyWithSeveralJointsGetsLinksInBetween) {
  const RobotFile robot = robot_of("two.xml", R"(<mujoco><worldbody><body name="b">
    <joint name="x" type="slide" axis="1 0 0"/><joint name="turn" axis="0 0 1"/>
    <geom type="sphere" size="0.1"/></body></worldbody></mujoco>)");
  const LinkJoint &x = by_name(robot.joints, "x"), &turn = by_name(robot.joints, "turn");
  EXPECT_EQ(x.parent, world_body);
  EXPECT_EQ(x.child, turn.parent);
  EXPECT_EQ(robot.links[turn.child].name, "b");
  EXPECT_FALSE(x.holds);  // MuJoCo has no motor there
}

/// Which of the shapes of an MJCF world may touch, as "a b, a c": in the order of the file.
std::string touching(const std::string& worldbody) {
  const RobotFile robot =
      robot_of("touch.xml", "<mujoco><worldbody>" + worldbody + "</worldbody></mujoco>");
  const Scene scene = robot_scene(robot, {}).scene;
  const Touching may(scene);
  std::string pairs;
  for (int a = 0; a < static_cast<int>(scene.bodies.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(scene.bodies.size()); ++b) {
      if (!may(a, b)) continue;
      pairs += (pairs.empty() ? "" : ", ") + scene.bodies[a].name + ' ' + scene.bodies[b].name;
    }
  }
  return pairs;
}

TEST(Mjcf, ABodyDoesNotTouchItsParentHoweverManyJointsAreBetween) {
  const std::string geom = "<geom size='0.1'/>", two_joints = "<joint axis='1 0 0'/><joint/>";
  EXPECT_EQ(
      touching("<body name='a'><freejoint/>" + geom + "<body name='b' pos='1 0 0'>" + two_joints +
               geom + "<body name='welded' pos='1 0 0'>" + geom + "<body name='c' pos='1 0 0'>" +
               two_joints + geom + "</body></body></body></body>"),
      "a c");
}

TEST(Mjcf, ABodyTouchesAParentThatTheWorldHolds) {
  const std::string geom = "<geom size='0.1'/>";
  EXPECT_EQ(touching("<body name='base'>" + geom + "<body name='arm' pos='1 0 0'><joint/>" + geom +
                     "</body></body>"),
            "base arm");
}

TEST(Mjcf, GeomsTouchByTheirOwnMasks) {
  EXPECT_EQ(touching(R"(<body name="a"><freejoint/>
      <geom name="low" size="0.1" contype="2" conaffinity="0"/>
      <geom name="high" pos="0 0 1" size="0.1"/></body>
    <body name="b" pos="3 0 0"><freejoint/>
      <geom name="left" size="0.1" contype="0" conaffinity="2"/>
      <geom name="right" pos="0 0 1" size="0.1"/></body>)"),
            "a/low b/left, a/high b/right");
}

TEST(Mjcf, ARootWithAFreejointIsABaseThatCanBeHeld) {
  const RobotFile robot =
      robot_of("free.xml", R"(<mujoco><worldbody><geom type="plane" size="1 1 1"/>
    <body name="base" pos="0 0 1"><freejoint/><geom type="sphere" size="0.1"/>
      <body name="arm" pos="0 0 1"><joint axis="0 1 0"/><geom type="sphere" size="0.1"/></body>
    </body></worldbody></mujoco>)");
  const Scene scene = robot_scene(robot, {.has_fixed_base = true}).scene;
  EXPECT_TRUE(by_name(scene.bodies, "base").fixed);
  EXPECT_FALSE(by_name(scene.bodies, "arm").fixed);
}

TEST(Mjcf, ObeysFlagsOrSaysThatItDoesNot) {
  const auto read = [](const std::string& flag) {
    return robot_of("flag.xml", "<mujoco><option><flag " + flag + R"(/></option><worldbody><body>
      <joint name="j" limited="true" range="-1 1"/><geom size="0.1"/></body></worldbody></mujoco>)");
  };
  EXPECT_EQ(read("sensor='disable'").gravity.z(), -9.81);
  EXPECT_THAT(read("sensor='disable'").ignored, testing::IsEmpty());
  EXPECT_EQ(read("gravity='disable'").gravity, Vec3(Vec3::Zero()));
  EXPECT_TRUE(std::isinf(read("limit='disable'").joints[0].upper));
  EXPECT_THAT(read("contact='disable'").ignored,
              Contains("flag contact: not read; bodies touch each other here"));
  EXPECT_THAT(read("actuation='disable'").ignored, Contains(HasSubstr("flag actuation: not read")));
}

TEST(Mjcf, ActuatorsOfOneJointAddTheirStrengths) {
  const auto effort = [](const std::string& second) {
    return robot_of("two.xml", R"(<mujoco><worldbody><body><joint name="j"/><geom size="0.1"/>
      </body></worldbody><actuator><motor joint="j" ctrllimited="true" ctrlrange="-1 1" gear="2"/>)" +
                                   second + "</actuator></mujoco>")
        .joints.at(0)
        .effort;
  };
  EXPECT_EQ(effort(""), 2);
  EXPECT_EQ(effort("<motor joint='j' ctrllimited='true' ctrlrange='-3 3'/>"), 5);
  EXPECT_EQ(effort("<motor joint='j'/>"), std::nullopt);
}

TEST(Mjcf, SaysThatGeomsWithoutFrictionHaveIt) {
  const RobotFile robot =
      robot_of("ice.xml", R"(<mujoco><worldbody><geom type="plane" size="1 1 1" condim="1"/>
    <body><freejoint/><geom size="0.1" condim="1"/></body></worldbody></mujoco>)");
  EXPECT_THAT(robot.ignored,
              testing::ElementsAre("condim 1 of 2 geoms: not read; contacts have friction here"));
}

TEST(Mjcf, IsToldByItsRootElement) {
  const std::string robot =
      "<robot name='r'><mujoco><compiler/></mujoco><link name='l'><collision>"
      "<geometry><sphere radius='1'/></geometry></collision></link></robot>";
  const auto links = [](const std::string& text) {
    return robot_of("root.xml", text).links.size();
  };
  EXPECT_EQ(links("<?xml version='1.0'?>\n<!-- <mujoco> -->\n" + robot), 1U) << "a URDF";
  EXPECT_EQ(links("<mujoco model='of a <robot'><worldbody/></mujoco>"), 1U) << "the world";
  EXPECT_EQ(links("<sdf version='1.7'><model name='m'><plugin name='p' filename='f'>"
                  "<robotNamespace>a</robotNamespace></plugin><link name='l'><collision name='c'>"
                  "<geometry><sphere><radius>1</radius></sphere></geometry></collision></link>"
                  "</model></sdf>"),
            1U);
}

TEST(Mjcf, ThatAsksForAllMemoryIsRefused) {
  EXPECT_THAT(refusal_of("part.xml",
                         "<mujoco><size nstack='2000000000'/><worldbody><geom "
                         "size='1'/></worldbody></mujoco>"),
              HasSubstr("scene is"));
}

TEST(Mjcf, WhatIsNoMjcfIsRefusedInMujocosWords) {
  const auto refusal = [](const std::string& body) {
    return refusal_of("part.xml", "<mujoco><worldbody>" + body + "</worldbody></mujoco>");
  };
  EXPECT_THAT(refusal("<geom type='cylinder' size='0.1'/>"), HasSubstr("must be MJCF: "));
  EXPECT_THAT(refusal("<geom tipe='box' size='1 1 1'/>"),
              HasSubstr("unrecognized attribute: 'tipe'"));
  EXPECT_THAT(refusal_of("part.xml", "<html/>"),
              HasSubstr("its root element is not mujoco, robot or sdf"));
}

}  // namespace
}  // namespace touchstone
