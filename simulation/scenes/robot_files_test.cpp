// URDF, SDF and MJCF: what is read from them and where, and which files are refused.
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>
#include <unistd.h>

#include "reference/invalid_input.hpp"
#include "simulation/assembly.hpp"
#include "simulation/scenes/robot_file.hpp"

namespace touchstone {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::filesystem::path scenes = TOUCHSTONE_SCENES;

const LinkShape& named(const RobotFile& file, const std::string& name) {
  for (const Link& link : file.links) {
    for (const LinkShape& s : link.shapes) {
      if (s.name == name) return s;
    }
  }
  throw std::runtime_error("no shape " + name);
}
template <class List>
const auto& by_name(const List& list, const std::string& name) {
  for (const auto& entry : list) {
    if (entry.name == name) return entry;
  }
  throw std::runtime_error("nothing is called " + name);
}
std::size_t shape_count(const RobotFile& file) {
  std::size_t count = 0;
  for (const Link& link : file.links) count += link.shapes.size();
  return count;
}

/// A file of this test's own.
struct Written {
  Written(const std::string& name, const std::string& text)
      : path(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + '-' + name)) {
    std::ofstream(path) << text;
  }
  ~Written() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

TEST(Urdf, GivesShapesAtTheDefaultPositionOfTheirJoints) {
  const RobotFile file = read_robot(scenes / "gripper.urdf");
  EXPECT_EQ(file.name, "arm_with_gripper");
  EXPECT_EQ(shape_count(file), 7U);
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
  EXPECT_THAT(ignored, Contains("collision forearm_link/cover: a mesh"));
  EXPECT_THAT(ignored,
              Contains("joint right_finger_joint: its mimic of left_finger_joint is not read; it "
                       "moves by itself"));
  EXPECT_THAT(ignored, Contains("transmission shoulder_transmission: not read"));
  EXPECT_THAT(ignored, Contains("gazebo forearm_link: not read but for its mu1"));
  EXPECT_THAT(ignored, Contains("the largest speed of joints elbow_joint, left_finger_joint, "
                                "right_finger_joint and shoulder_pan_joint: not read"));
  EXPECT_EQ(ignored.size(), 5U);
}

TEST(Sdf, GivesShapesWhereTheyAreInTheWorld) {
  const RobotFile file = read_robot(scenes / "warehouse.sdf");
  EXPECT_EQ(file.name, "warehouse");
  EXPECT_EQ(shape_count(file), 9U);
  const LinkShape& roller = named(file, "roller_conveyor::frame/roller_2");
  EXPECT_TRUE(by_name(file.links, "roller_conveyor::frame").fixed);
  EXPECT_NEAR((roller.pose.position() - Vec3(-0.6, 0, 0.42)).norm(), 0, 1e-12);
  EXPECT_NEAR((roller.pose.axis() - Vec3(0, -1, 0)).norm(), 0, 1e-5);
  const auto& bumper = std::get<Capsule>(named(file, "cart::tray/bumper").shape);
  EXPECT_EQ(bumper.half_length(), 0.2);
  EXPECT_TRUE(std::holds_alternative<Plane>(named(file, "ground_plane::link/collision").shape));
  const LinkJoint& axle = by_name(file.joints, "cart::wheel_axle");
  EXPECT_EQ(file.links[axle.parent].name, "cart::tray");
  EXPECT_EQ(file.links[axle.child].name, "cart::wheel");
  EXPECT_NEAR((axle.axis - Vec3(0, -1, 0)).norm(), 0, 1e-5);
  EXPECT_NEAR((axle.anchor - Vec3(0.3, 1.8, 0.12)).norm(), 0, 1e-12);
}

TEST(Sdf, SaysWhatItIgnores) {
  const auto ignored = read_robot(scenes / "warehouse.sdf").ignored;
  EXPECT_THAT(ignored, Contains(HasSubstr("collision cart::tray/hull: a mesh")));
  EXPECT_THAT(ignored, Contains("plugin ignition::gazebo::systems::Physics: not read"));
  EXPECT_THAT(ignored, Contains("sensor touch: not read"));
}

TEST(RobotFiles, ThatAreBadAreRefused) {
  EXPECT_THROW(read_robot("/nowhere/robot.urdf"), InvalidInput);
  EXPECT_THROW(read_robot("/nowhere/world.sdf"), InvalidInput);
  const Written no_robot("robot.urdf", "<robot"), no_world("world.sdf", "<sdf version='1.7'>");
  EXPECT_THROW(read_robot(no_robot.path), InvalidInput);
  EXPECT_THROW(read_robot(no_world.path), InvalidInput);
  const Written flat("flat.urdf",
                     "<robot name='r'><link name='l'><collision name='c'><geometry>"
                     "<sphere radius='0'/></geometry></collision></link></robot>");
  try {
    read_robot(flat.path);
    FAIL() << "accepted";
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("l/c.radius is 0"));
  }
}

/// Why a file with a collision "broken" of a link "mid" is refused.
std::string refusal_of(const std::string& name, const std::string& text) {
  const Written file(name, text);
  try {
    return fmt::format("accepted with {} shapes", shape_count(read_robot(file.path)));
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), HasSubstr(file.path.string()));
    return e.what();
  }
}
std::string urdf_refusal(const std::string& geometry, const std::string& before = "") {
  return refusal_of("part.urdf", "<robot name='r'><link name='base'/><link name='mid'>" + before +
                                     "<collision name='broken'>" + geometry + R"(</collision></link>
    <joint name='j' type='fixed'><parent link='base'/><child link='mid'/></joint></robot>)");
}
std::string sdf_refusal(const std::string& geometry, const std::string& version = "1.7") {
  return refusal_of("part.sdf", "<sdf version='" + version + R"('><world name='w'><model name='m'>
    <link name='mid'><collision name='broken'>)" +
                                    geometry + "</collision></link></model></world></sdf>");
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
  EXPECT_EQ(of("<mesh filename='a.stl'/>"), "accepted with 0 shapes");
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

TEST(Sdf, RefusesAShapeThatItsReaderWouldReplaceByADefault) {
  const auto of = [](const std::string& shape) {
    return sdf_refusal("<geometry>" + shape + "</geometry>");
  };
  const std::string length = "<length>1</length>";
  EXPECT_EQ(of("<cylinder><radius> 0.2 </radius>" + length + "</cylinder>"),
            "accepted with 1 shapes");
  EXPECT_EQ(of("<plane><normal>0 0 1</normal></plane>"), "accepted with 1 shapes");
  EXPECT_THAT(
      of("<cylinder><radiu>0.2</radiu>" + length + "</cylinder>"),
      HasSubstr("collision m::mid/broken.cylinder.radiu is unknown: must be one of radius"));
  EXPECT_THAT(of("<cylinder>" + length + "</cylinder>"),
              HasSubstr("collision m::mid/broken.cylinder.radius is missing"));
  EXPECT_THAT(of("<cylinder><radius>0.2m</radius>" + length + "</cylinder>"),
              HasSubstr("cylinder.radius is \"0.2m\": must be a number"));
  EXPECT_THAT(of("<sphere><radius>1</radius><radius>2</radius></sphere>"),
              HasSubstr("sphere.radius is there more than once"));
  EXPECT_THAT(of("<box><size>1 2 3 4</size></box>"), HasSubstr("box.size is \"1 2 3 4\""));
  EXPECT_THAT(of("<cilinder/>"), HasSubstr("m::mid/broken.geometry is \"cilinder\""));
  EXPECT_THAT(of(""), HasSubstr("m::mid/broken.geometry is empty"));
}

TEST(Sdf, ChecksTheModelsThatItIncludes) {
  const auto folder = std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "-can");
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "model.config")
      << "<model><name>can</name><sdf version='1.7'>model.sdf</sdf></model>";
  const Written world("world.sdf", "<sdf version='1.7'><world name='w'><include><uri>" +
                                       folder.string() + "</uri></include></world></sdf>");
  const auto read_with = [&](const std::string& radius) -> std::string {
    std::ofstream(folder / "model.sdf")
        << "<sdf version='1.7'><model name='can'><link name='l'><collision name='c'><geometry>"
           "<sphere>" +
               radius + "</sphere></geometry></collision></link></model></sdf>";
    try {
      return fmt::format("{} shapes", shape_count(read_robot(world.path)));
    } catch (const InvalidInput& e) {
      return e.what();
    }
  };
  EXPECT_EQ(read_with("<radius>0.2</radius>"), "1 shapes");
  EXPECT_THAT(read_with("<radiu>0.2</radiu>"),
              HasSubstr((folder / "model.sdf").string() +
                        ": collision can::l/c.sphere.radiu is unknown: must be one of radius"));
  std::filesystem::remove_all(folder);
}

TEST(Sdf, RefusesAPoseOfWhichItsReaderWouldIgnoreAUnit) {
  const std::string ball = "<geometry><sphere><radius>1</radius></sphere></geometry>";
  EXPECT_EQ(sdf_refusal("<pose>0 0 1 0 0 0</pose>" + ball), "accepted with 1 shapes");
  EXPECT_THAT(sdf_refusal("<pose>0 0 1m 0 0 0</pose>" + ball),
              HasSubstr("collision m::mid/broken.pose is \"0 0 1m 0 0 0\": must be numbers"));
}

TEST(Sdf, RefusesAVersionThatItsReaderDoesNotKnow) {
  const std::string ball = "<geometry><sphere><radius>1</radius></sphere></geometry>";
  EXPECT_EQ(sdf_refusal(ball, "1.6"), "accepted with 1 shapes");
  for (const char* version : {"9.9", "1.99", "1.x", "1", ""}) {
    EXPECT_THAT(sdf_refusal(ball, version), testing::Not(HasSubstr("accepted"))) << version;
  }
  EXPECT_THAT(sdf_refusal(ball, "9.9"), HasSubstr("sdf.version is \"9.9\": must be 1.0 to 1."));
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
  const Written file("joint.urdf", wheeled(joint_of("revolute",
                                                    "<axis xyz='0 0 2'/><limit lower='-1' "
                                                    "upper='2' effort='7' velocity='1'/>")));
  const RobotFile robot = read_robot(file.path);
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
  EXPECT_THAT(joint_refusal("revolute",
                            "<axis xyz='0 0 1'/><limit lower='2' upper='1' effort='1' "
                            "velocity='1'/>"),
              HasSubstr("joint axle.limit.lower is 2: must not lie above the upper limit"));
  EXPECT_THAT(joint_refusal("revolute",
                            "<axis xyz='0 0 1'/><limit lower='nan' upper='1' effort='1' "
                            "velocity='1'/>"),
              HasSubstr("lower"));
  EXPECT_THAT(joint_refusal("revolute",
                            "<axis xyz='0 0 1'/><limit lower='-1' upper='1' "
                            "effort='-1' velocity='1'/>"),
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
    const Written file("joint.urdf", wheeled(joint_of(type, "<axis xyz='0 0 1'/>")));
    return read_robot(file.path).ignored;
  };
  EXPECT_THAT(ignored("planar"), Contains("joint axle: planar; taken as fixed"));
  EXPECT_THAT(ignored("floating"),
              Contains("joint axle: floating, so that both links move freely"));
  EXPECT_TRUE(ignored("fixed").empty());
}

TEST(Urdf, SaysWhatOfItsJointsItIgnores) {
  const auto ignored = [](const std::string& content) {
    const Written file("joint.urdf", wheeled(joint_of("continuous", content)));
    return read_robot(file.path).ignored;
  };
  EXPECT_THAT(ignored("<dynamics damping='0.5' friction='0.1'/><limit effort='1' velocity='9'/>"),
              testing::UnorderedElementsAre("damping of joint axle: not read",
                                            "friction of joint axle: not read",
                                            "the largest speed of joint axle: not read"));
  EXPECT_THAT(ignored("<dynamics damping='0' friction='0'/><limit effort='1' velocity='0'/>"),
              testing::IsEmpty());
}

TEST(RobotFiles, SayOnceWhatOfManyJointsIsNotRead) {
  UnreadOfJoints unread;
  const auto said = [&] {
    RobotFile robot;
    unread.note(robot);
    return robot.ignored.at(0);
  };
  unread.add("damping", 0, "none");
  for (const char* joint : {"a", "b"}) unread.add("damping", 1, joint);
  EXPECT_EQ(said(), "damping of joints a and b: not read");
  for (const char* joint : {"c", "d", "e"}) unread.add("damping", 1, joint);
  EXPECT_EQ(said(), "damping of joints a, b, c and 2 others: not read");
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
                         "<sdf version='1.7'><world name='w'><gravity>0 0 down"
                         "</gravity></world></sdf>"),
              HasSubstr("its reader says: Unknown error. Unable to set value [0 0 down"));
  EXPECT_THAT(refusal_of("part.xml", "<mujoco><worldbody><geom size='x'/></worldbody></mujoco>"),
              HasSubstr("must be MJCF: "));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

/// A folder of this test's own.
struct Folder {
  explicit Folder(const std::string& name)
      : path(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + '-' + name)) {
    std::filesystem::create_directory(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  /// Writes a model with this content; its first link is "l".
  void model(const std::string& name, const std::string& content) const {
    std::filesystem::create_directory(path / name);
    std::ofstream(path / name / "model.config")
        << "<model><name>" << name << "</name><sdf version='1.7'>model.sdf</sdf></model>";
    std::ofstream(path / name / "model.sdf")
        << "<sdf version='1.7'><model name='" << name << "'>" << content << "</model></sdf>";
  }
  std::filesystem::path path;
};

struct IncludedModels : testing::Test {
  const std::string ball =
      "<link name='l'><collision name='c'><geometry><sphere><radius>0.2</radius></sphere>"
      "</geometry></collision></link>";
  Folder models{"models"};

  /// What becomes of a world that includes this URI.
  static std::string with(const std::string& uri,
                          const std::vector<std::filesystem::path>& folders = {}) {
    const Written world("world.sdf", "<sdf version='1.7'><world name='w'><include><uri>" + uri +
                                         "</uri></include></world></sdf>");
    try {
      return fmt::format("{} shapes", shape_count(read_robot(world.path, folders)));
    } catch (const InvalidInput& e) {
      return e.what();
    }
  }
};

TEST_F(IncludedModels, AreFoundByOptionAndByTheEnvironment) {
  models.model("ball", ball);
  EXPECT_THAT(with("model://ball"), HasSubstr("include.uri is \"model://ball\": must name a model "
                                              "in a folder of --model-path, SDF_PATH"));
  EXPECT_EQ(with("model://ball", {models.path}), "1 shapes");
  EXPECT_EQ(with("package://ball", {models.path}), "1 shapes");
  EXPECT_EQ(with(" model://ball/model.sdf\n", {models.path}), "1 shapes");
  for (const char* variable : {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
    setenv(variable, ("/nowhere:" + models.path.string()).c_str(), 1);
    EXPECT_EQ(with("model://ball"), "1 shapes") << variable;
    unsetenv(variable);
  }
}

TEST_F(IncludedModels, ThatIncludeThemselvesOrAreNotHereAreRefused) {
  models.model("a", ball + "<include><uri>model://b</uri></include>");
  models.model("b", ball + "<include><uri>model://a</uri></include>");
  EXPECT_THAT(with("model://a", {models.path}), HasSubstr("must not include itself"));
  EXPECT_THAT(with("https://fuel.gazebosim.org/1.0/model"), HasSubstr("must be on this machine"));
  std::filesystem::create_directory(models.path / "empty");
  EXPECT_THAT(with("model://empty", {models.path}), HasSubstr("model.config"));
  EXPECT_THAT(with(""), HasSubstr("include.uri is \"\""));
}

TEST(Sdf, GivesMassFrictionAndGravity) {
  const RobotFile world = read_robot(scenes / "loading-bay.sdf");
  EXPECT_TRUE(world.is_world);
  EXPECT_EQ(world.gravity.z(), -9.8);
  EXPECT_EQ(by_name(world.links, "cart_1::tray").mass, 6);
  EXPECT_EQ(named(world, "cart_1::front_left_wheel/tyre").friction, 0.9);
  EXPECT_FALSE(named(world, "barrel::link/body").friction);
  EXPECT_TRUE(by_name(world.links, "post::link").fixed);
  EXPECT_EQ(world.left_out.shapes, 1U);
  EXPECT_THAT(world.ignored, Contains("light sun: not read"));
}

TEST(Sdf, SaysWhatItDoesInsteadOfOtherJoints) {
  const std::string link =
      "<collision name='c'><geometry><sphere><radius>1</radius></sphere>"
      "</geometry></collision></link>";
  const Written file("ball.sdf", "<sdf version='1.7'><model name='m'><link name='a'>" + link +
                                     "<link name='b'>" + link +
                                     "<joint name='j' type='ball'><parent>a</parent>"
                                     "<child>b</child></joint></model></sdf>");
  const RobotFile robot = read_robot(file.path);
  EXPECT_THAT(robot.ignored, Contains("joint m::j: ball; taken as fixed"));
  EXPECT_EQ(by_name(robot.joints, "m::j").kind, JointKind::fixed);
}

TEST(Sdf, SaysWhatOfAWorldAndItsJointsItIgnores) {
  const std::string link =
      "<collision name='c'><geometry><sphere><radius>1</radius></sphere>"
      "</geometry></collision></link>";
  const auto ignored = [&](const std::string& of_world, const std::string& of_axis) {
    const Written file("axis.sdf",
                       "<sdf version='1.7'><world name='w'>" + of_world +
                           "<model name='m'><link name='a'>" + link + "<link name='b'>" + link +
                           "<joint name='j' type='revolute'><parent>a</parent><child>b</child>"
                           "<axis><xyz>0 0 1</xyz>" +
                           of_axis + "</axis></joint></model></world></sdf>");
    return read_robot(file.path).ignored;
  };
  EXPECT_THAT(
      ignored("<physics name='fast' type='ode'><max_step_size>0.002</max_step_size></physics>"
              "<state world_name='w'/>",
              "<limit><velocity>3</velocity></limit><dynamics><damping>1</damping>"
              "<friction>2</friction><spring_stiffness>4</spring_stiffness></dynamics>"),
      testing::UnorderedElementsAre(
          "physics fast: not read", "state w: not read", "damping of joint m::j: not read",
          "friction of joint m::j: not read", "the spring of joint m::j: not read",
          "the largest speed of joint m::j: not read"));
  EXPECT_THAT(ignored("", "<limit><velocity>-1</velocity></limit>"), testing::IsEmpty());
}

TEST(Mjcf, SaysWhatOfItsJointsItIgnores) {
  const Written file("joint.xml", R"(<mujoco><worldbody><body>
    <joint name="j" damping="1" frictionloss="2" armature="3" stiffness="4"/><geom size="0.1"/>
    <body pos="1 0 0"><joint name="plain"/><geom size="0.1"/></body></body></worldbody></mujoco>)");
  EXPECT_THAT(read_robot(file.path).ignored,
              testing::UnorderedElementsAre(
                  "damping of joint j: not read", "friction of joint j: not read",
                  "armature of joint j: not read", "the spring of joint j: not read"));
}

TEST(Mjcf, GivesShapesJointsAndActuators) {
  const RobotFile robot = read_robot(scenes / "pincer.xml");
  EXPECT_EQ(robot.name, "pincer");
  EXPECT_EQ(robot.step, 0.004);
  EXPECT_EQ(shape_count(robot), 5U);  // without the mesh and what collides with nothing
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
  EXPECT_THAT(robot.ignored, Contains("geom hand/wedge: a mesh"));
  EXPECT_THAT(robot.ignored, Contains("1 tendon: not read"));
  EXPECT_THAT(robot.ignored, Contains("1 sensor: not read"));
  EXPECT_THAT(robot.ignored, Contains("1 site: not read"));
  // A tetrahedron of three edges of 30 mm at right angles.
  EXPECT_NEAR(robot.left_out.volume, 0.03 * 0.03 * 0.03 / 6, 1e-9);
  EXPECT_THAT(left_out_text(robot), HasSubstr("left out: 1 of 6 collision shapes ("));
}

TEST(Mjcf, ABodyWithSeveralJointsGetsLinksInBetween) {
  const Written file("two.xml", R"(<mujoco><worldbody><body name="b">
    <joint name="x" type="slide" axis="1 0 0"/><joint name="turn" axis="0 0 1"/>
    <geom type="sphere" size="0.1"/></body></worldbody></mujoco>)");
  const RobotFile robot = read_robot(file.path);
  const LinkJoint &x = by_name(robot.joints, "x"), &turn = by_name(robot.joints, "turn");
  EXPECT_EQ(x.parent, world_body);
  EXPECT_EQ(x.child, turn.parent);
  EXPECT_EQ(robot.links[turn.child].name, "b");
  EXPECT_FALSE(x.holds);  // MuJoCo has no motor there
}

/// Which of the shapes of an MJCF world may touch, as "a b, a c": in the order of the file.
std::string touching(const std::string& worldbody) {
  const Written file("touch.xml", "<mujoco><worldbody>" + worldbody + "</worldbody></mujoco>");
  const Scene scene = robot_scene(read_robot(file.path), {}).scene;
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
  const Written file("free.xml", R"(<mujoco><worldbody><geom type="plane" size="1 1 1"/>
    <body name="base" pos="0 0 1"><freejoint/><geom type="sphere" size="0.1"/>
      <body name="arm" pos="0 0 1"><joint axis="0 1 0"/><geom type="sphere" size="0.1"/></body>
    </body></worldbody></mujoco>)");
  RobotMotion motion;
  motion.has_fixed_base = true;
  const Scene scene = robot_scene(read_robot(file.path), motion).scene;
  EXPECT_TRUE(by_name(scene.bodies, "base").fixed);
  EXPECT_FALSE(by_name(scene.bodies, "arm").fixed);
}

TEST(Mjcf, ThatAsksForAllMemoryIsRefused) {
  EXPECT_THAT(refusal_of("part.xml",
                         "<mujoco><size nstack='2000000000'/><worldbody><geom "
                         "size='1'/></worldbody></mujoco>"),
              HasSubstr("scene is"));
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

TEST(Mjcf, WhatIsNoMjcfIsRefusedInMujocosWords) {
  const auto refusal = [](const std::string& body) {
    return refusal_of("part.xml", "<mujoco><worldbody>" + body + "</worldbody></mujoco>");
  };
  EXPECT_THAT(refusal("<geom type='cylinder' size='0.1'/>"), HasSubstr("must be MJCF: "));
  EXPECT_THAT(refusal("<geom tipe='box' size='1 1 1'/>"),
              HasSubstr("unrecognized attribute: 'tipe'"));
  EXPECT_THAT(refusal_of("part.xml", "<html/>"),
              HasSubstr("it has no element mujoco, robot or sdf"));
}

}  // namespace
}  // namespace touchstone
