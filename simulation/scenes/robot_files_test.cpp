// URDF: what is read and where, and which files are refused; and what URDF, SDF and MJCF share.
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "simulation/scenes/robot_files_fixture.hpp"

namespace touchstone {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(Urdf, GivesShapesAtTheDefaultPositionOfTheirJoints) {
  const RobotFile file = read_robot(scenes / "gripper.urdf");
  EXPECT_EQ(file.name, "arm_with_gripper");
  EXPECT_EQ(shape_count(file), 8U);
  const auto& tube = std::get<Cylinder>(named(file, "upper_arm_link/tube").shape);
  EXPECT_EQ(tube.radius(), 0.06);
  EXPECT_EQ(tube.half_length(), 0.2);  // URDF gives the whole length
  // Turned by 0.6 about y at 0.1 m, then 0.2 m along it.
  const Pose& pose = named(file, "upper_arm_link/tube").pose;
  EXPECT_NEAR((pose.position() - Vec3(0.2 * std::sin(0.6), 0, 0.1 + 0.2 * std::cos(0.6))).norm(), 0,
              1e-12);
  EXPECT_NEAR((pose.axis() - Vec3(std::sin(0.6), 0, std::cos(0.6))).norm(), 0, 1e-12);
  const LinkJoint& tool = by_name(file.joints, "tool_joint");
  EXPECT_EQ(file.links[tool.parent].name, "palm_link");
  EXPECT_EQ(file.links[tool.child].name, "camera_link");
}

TEST(Urdf, APercentSignDoesNotEndTheProcess) {
  const Written file("percent.urdf",
                     R"(<robot name="r"><link name="a"><collision><origin xyz="0%n 0 0"/><geometry>
                        <sphere radius="1"/></geometry></collision></link></robot>)");
  EXPECT_THROW(read_robot(file.path), InvalidInput);
}

TEST(Urdf, SaysWhatItIgnores) {
  const auto ignored = read_robot(scenes / "gripper.urdf").ignored;
  EXPECT_THAT(
      ignored,
      Contains(
          "package://arm_description/meshes/bracket.stl: its hull is 90% larger than the mesh"));
  EXPECT_THAT(ignored,
              Contains("joint right_finger_joint: its mimic of left_finger_joint is not read; it "
                       "moves by itself"));
  EXPECT_THAT(ignored, Contains("transmission shoulder_transmission: not read"));
  EXPECT_THAT(ignored, Contains("gazebo forearm_link: not read but for its mu1"));
  EXPECT_THAT(ignored, Contains("the largest speed of joints elbow_joint, left_finger_joint, "
                                "right_finger_joint and shoulder_pan_joint: not read"));
  EXPECT_EQ(ignored.size(), 5U);
}

TEST(RobotFiles, ThatAreBadAreRefused) {
  EXPECT_THROW(read_robot("/nowhere/robot.urdf"), InvalidInput);
  EXPECT_THROW(read_robot("/nowhere/world.sdf"), InvalidInput);
  for (const auto& [name, text] :
       {std::pair{"robot.urdf", "<robot"}, {"world.sdf", "<sdf version='1.7'>"}}) {
    EXPECT_THAT(refusal_of(name, text), testing::Not(HasSubstr("accepted")));
  }
  EXPECT_THAT(refusal_of("flat.urdf",
                         "<robot name='r'><link name='l'><collision name='c'><geometry>"
                         "<sphere radius='0'/></geometry></collision></link></robot>"),
              HasSubstr("l/c.radius is 0"));
}

/// Why a file with a collision "broken" of a link "mid" is refused.
std::string urdf_refusal(const std::string& geometry, const std::string& before = "") {
  return refusal_of("part.urdf", "<robot name='r'><link name='base'/><link name='mid'>" + before +
                                     "<collision name='broken'>" + geometry + R"(</collision></link>
    <joint name='j' type='fixed'><parent link='base'/><child link='mid'/></joint></robot>)");
}

TEST(RobotFiles, OfAnotherEncodingOrWithControlCharactersInNamesAreRefused) {
  const auto urdf = [](const std::string& robot, const std::string& link) {
    return refusal_of("part.urdf", "<?xml version='1.0' encoding='ISO-8859-1'?>\n<robot name='" +
                                       robot + "'><link name='" + link +
                                       "'><collision><geometry><sphere radius='1'/></geometry>"
                                       "</collision></link></robot>");
  };
  EXPECT_THAT(urdf("r", "caf\xe9"), HasSubstr("must be UTF-8, whatever it says itself: line 2"));
  EXPECT_EQ(urdf("r", "café"), "accepted with 1 shapes");
  EXPECT_THAT(urdf("r\x1b[2J", "l"), HasSubstr("name is "));
  EXPECT_THAT(urdf("r", "l\x1b[2J"), HasSubstr("must be without characters that are not seen"));
  EXPECT_THAT(refusal_of("part.sdf", "<sdf version='1.7'><model name='caf\xe9'/></sdf>"),
              HasSubstr("must be UTF-8"));
}

TEST(Urdf, RefusesAShapeThatItsReaderWouldDrop) {
  const auto of = [](const std::string& shape) {
    return urdf_refusal("<geometry>" + shape + "</geometry>");
  };
  EXPECT_EQ(of("<cylinder radius='+0.5' length='1e0'/>"), "accepted with 1 shapes");
  EXPECT_THAT(of("<mesh scale='1 1 1'/>"), HasSubstr("mid/broken.mesh.filename is missing"));
  EXPECT_THAT(of("<cylinder radius='oops' length='1'/>"),
              HasSubstr("collision mid/broken.cylinder.radius is \"oops\": must be a number"));
  EXPECT_THAT(of("<cylinder radius='0,5' length='1'/>"), HasSubstr("cylinder.radius is \"0,5\""));
  EXPECT_THAT(of("<cylinder radius='0x1p-1' length='1'/>"), HasSubstr("cylinder.radius is"));
  EXPECT_THAT(of("<cylinder radius='1' lenght='1'/>"),
              HasSubstr("cylinder.lenght is unknown: must be one of radius, length"));
  EXPECT_THAT(of("<sphere/>"), HasSubstr("mid/broken.sphere.radius is missing"));
  EXPECT_THAT(of("<box size='1 2'/>"),
              HasSubstr("box.size is \"1 2\": must be 3 numbers between spaces"));
  EXPECT_THAT(of("<cilinder radius='1' length='1'/>"),
              HasSubstr("geometry is \"cilinder\": must hold one of sphere, cylinder, box, mesh"));
  EXPECT_THAT(of(""), HasSubstr("mid/broken.geometry is empty"));
  EXPECT_THAT(urdf_refusal("<geometri/>"), HasSubstr("mid/broken.geometry is missing"));
}

TEST(Urdf, ThatIsNotXmlIsRefusedWithTheLine) {
  EXPECT_THAT(refusal_of("part.urdf", "<robot name='r'>\n<link"),
              HasSubstr("must be XML: expected > at line 2"));
}

TEST(Urdf, RefusesALinkOfWhichItsReaderDropsACollision) {
  const std::string ball = "<geometry><sphere radius='1'/></geometry>";
  EXPECT_THAT(urdf_refusal("<origin xyz='0 0 oops'/>" + ball),
              HasSubstr("link mid is read with 0 of 1 collisions"));
  EXPECT_THAT(urdf_refusal(ball, "<visual><geometry><box size='1'/></geometry></visual>"),
              HasSubstr("link mid is read with 0 of 1 collisions"));
}

TEST(Urdf, MayHaveAnyNumberOfClosingBracketsInQuotes) {
  std::string links;
  for (int i = 0; i < 120; ++i) links += fmt::format("<gazebo reference='a->{}'/>", i);
  EXPECT_EQ(refusal_of("arrows.urdf",
                       "<robot name='r'><link name='l'><collision><geometry>"
                       "<sphere radius='1'/></geometry></collision></link>" +
                           links + "</robot>"),
            "accepted with 1 shapes");
}

TEST(Urdf, ARootNamedWorldIsTheWorldWithOrWithoutShapes) {
  const auto is_fixed = [](const std::string& collision) {
    return robot_of("world.urdf",
                    "<robot name='r'><link name='world'>" + collision + "</link></robot>")
        .links.front()
        .fixed;
  };
  EXPECT_TRUE(is_fixed(""));
  EXPECT_TRUE(is_fixed("<collision><geometry><box size='1 1 0.8'/></geometry></collision>"));
}

/// A URDF of a box on a wheel, with a joint of this kind between them.
std::string wheeled(const std::string& joint) {
  return R"(<robot name='r'>
    <link name='base'><collision><geometry><box size='1 1 0.2'/></geometry></collision></link>
    <link name='wheel'><inertial><mass value='3'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0'
      izz='1'/></inertial><collision><geometry><cylinder radius='0.5' length='0.2'/></geometry>
      </collision></link>)" +
         joint + "</robot>";
}
std::string joint_of(const std::string& type, const std::string& content,
                     const std::string& child = "wheel") {
  return "<joint name='axle' type='" + type + "'><parent link='base'/><child link='" + child +
         "'/><origin xyz='0 1 0' rpy='1.5707963267948966 0 0'/>" + content + "</joint>";
}
std::string joint_refusal(const std::string& type, const std::string& content) {
  return refusal_of("joint.urdf", wheeled(joint_of(type, content)));
}

TEST(Urdf, GivesJointsWithAxisLimitsAndEffort) {
  const RobotFile robot = robot_of(
      "joint.urdf",
      wheeled(joint_of(
          "revolute", "<axis xyz='0 0 2'/><limit lower='-1' upper='2' effort='7' velocity='1'/>")));
  const LinkJoint& axle = by_name(robot.joints, "axle");
  EXPECT_EQ(axle.kind, JointKind::hinge);
  EXPECT_NEAR((axle.anchor - Vec3(0, 1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((axle.axis.normalized() - Vec3(0, -1, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(axle.lower, -1);
  EXPECT_EQ(axle.upper, 2);
  EXPECT_EQ(axle.effort, 7);
  EXPECT_EQ(by_name(robot.links, "wheel").mass, 3);
  EXPECT_FALSE(by_name(robot.links, "base").mass);
}

TEST(Urdf, JointsThatMakeNoSenseAreRefused) {
  const std::string good =
      "<axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/>";
  EXPECT_EQ(joint_refusal("revolute", good), "accepted with 2 shapes");
  EXPECT_THAT(
      joint_refusal("continuous", "<axis xyz='0 0 0'/>"),
      HasSubstr("joint axle.axis is \"0 0 0\": must be three finite numbers, not all zero"));
  const auto of_limit = [](const char* limit) {
    return joint_refusal("revolute",
                         fmt::format("<axis xyz='0 0 1'/><limit {} velocity='1'/>", limit));
  };
  EXPECT_THAT(of_limit("lower='2' upper='1' effort='1'"),
              HasSubstr("joint axle.limit.lower is 2: must not lie above the upper limit"));
  EXPECT_THAT(of_limit("lower='nan' upper='1' effort='1'"), HasSubstr("lower"));
  EXPECT_THAT(of_limit("lower='-1' upper='1' effort='-1'"),
              HasSubstr("joint axle.limit.effort is -1: must not be negative"));
  EXPECT_THAT(joint_refusal("hovering", good), HasSubstr("hovering"));
  EXPECT_THAT(refusal_of("joint.urdf", wheeled(joint_of("fixed", "", "nothing"))),
              HasSubstr("nothing"));
}

TEST(Urdf, JointsThatFormNoTreeAreRefused) {
  const auto of = [](const std::string& joints) {
    std::string text = "<robot name='r'><link name='root'/><link name='a'/><link name='b'/>";
    std::istringstream in(joints);
    std::string parent, child;
    for (int i = 1; in >> parent >> child; ++i) {
      text += "<joint name='j" + std::to_string(i) + "' type='fixed'><parent link='" + parent +
              "'/><child link='" + child + "'/></joint>";
    }
    return refusal_of("part.urdf", text + "</robot>");
  };
  EXPECT_EQ(of("root a a b"), "accepted with 0 shapes");
  EXPECT_THAT(of("root a root b b a"),
              HasSubstr("joint j3.child is \"a\": must be the child of no other joint"));
  EXPECT_THAT(of("a b b a"),
              HasSubstr("link a is in a circle of joints: must hang on link root by joints"));
}

TEST(Urdf, SaysWhatItDoesInsteadOfOtherJoints) {
  const auto ignored = [](const std::string& type) {
    return robot_of("joint.urdf", wheeled(joint_of(type, "<axis xyz='0 0 1'/>"))).ignored;
  };
  EXPECT_THAT(ignored("planar"), Contains("joint axle: planar; taken as fixed"));
  EXPECT_THAT(ignored("floating"),
              Contains("joint axle: floating, so that both links move freely"));
  EXPECT_TRUE(ignored("fixed").empty());
}

TEST(Urdf, SaysWhatOfItsJointsItIgnores) {
  const auto ignored = [](const std::string& content) {
    return robot_of("joint.urdf", wheeled(joint_of("continuous", content))).ignored;
  };
  EXPECT_THAT(ignored("<dynamics damping='0.5' friction='0.1'/><limit effort='1' velocity='9'/>"),
              testing::UnorderedElementsAre("damping of joint axle: not read",
                                            "friction of joint axle: not read",
                                            "the largest speed of joint axle: not read"));
  EXPECT_THAT(ignored("<dynamics damping='0' friction='0'/><limit effort='1' velocity='0'/>"),
              testing::IsEmpty());
}

TEST(RobotFiles, SayOnceWhatOfManyJointsIsNotRead) {
  const auto said = [](int joints) {
    std::string text = "<link name='base'/>";
    for (int i = 0; i < joints; ++i) {
      text += fmt::format(
          "<link name='l{0}'/><joint name='{1}' type='continuous'><parent link='base'/>"
          "<child link='l{0}'/><dynamics damping='{2}'/></joint>",
          i, static_cast<char>('a' + i), i == 2 ? 0 : 1);
    }
    return robot_of("joints.urdf", "<robot name='r'>" + text + "</robot>").ignored.at(0);
  };
  EXPECT_EQ(said(3), "damping of joints a and b: not read");
  EXPECT_EQ(said(6), "damping of joints a, b, d and 2 others: not read");
}

TEST(Urdf, ReadsTheFrictionOfGazebosElement) {
  const RobotFile robot = read_robot(scenes / "rover.urdf");
  EXPECT_EQ(named(robot, "front_left_wheel/tyre").friction, 0.9);
  EXPECT_FALSE(named(robot, "chassis/hull").friction);
  EXPECT_THAT(refusal_of("mu.urdf", wheeled(joint_of("fixed", "") +
                                            "<gazebo reference='wheel'><mu1>-1</mu1></gazebo>")),
              HasSubstr("gazebo wheel.mu1 is \"-1\": must be a number that is not negative"));
}

TEST(Urdf, UnexpandedXacroIsNamedAsSuch) {
  EXPECT_THAT(refusal_of("robot.urdf",
                         "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>"
                         "<xacro:property name='w' value='1'/></robot>"),
              HasSubstr("must be expanded first: it is a xacro file"));
  EXPECT_THAT(refusal_of("robot.xacro", "<robot name='r'/>"), HasSubstr("`xacro FILE"));
}

TEST(RobotFiles, NothingThatALibraryPrintsReachesTheTerminal) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_THAT(refusal_of("part.urdf", wheeled("")), HasSubstr("its reader says: "));
  EXPECT_THAT(joint_refusal("revolute", ""), HasSubstr("its reader says: "));
  EXPECT_THAT(refusal_of("part.sdf", "<sdf version='1.7'><model name='m'/></sdf>"),
              HasSubstr("must be SDF: A model must have at least one link."));
  EXPECT_THAT(refusal_of("part.sdf",
                         "<sdf version='1.7'><world name='w'><magnetic_field>0 0 down"
                         "</magnetic_field></world></sdf>"),
              HasSubstr("its reader says: Unknown error. Unable to set value [0 0 down"));
  EXPECT_THAT(refusal_of("part.xml", "<mujoco><worldbody><geom size='x'/></worldbody></mujoco>"),
              HasSubstr("must be MJCF: "));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(RobotFiles, WithTooManyLinksAreRefused) {
  std::string text = "<robot name='r'><link name='l0'/>";
  for (std::size_t i = 1; i <= max_links; ++i) {
    text += fmt::format(
        "<link name='l{0}'/><joint name='j{0}' type='fixed'><parent link='l0'/>"
        "<child link='l{0}'/></joint>",
        i);
  }
  EXPECT_THAT(refusal_of("part.urdf", text + "</robot>"),
              HasSubstr("must have at most 2000 links and joints, not 2001 and 2000"));
}

}  // namespace
}  // namespace touchstone
