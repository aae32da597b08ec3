// URDF and SDF: which shapes are read from them and where, and which files are refused.
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>
#include <unistd.h>

#include "reference/invalid_input.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::filesystem::path scenes = TOUCHSTONE_SCENES;

const PlacedShape& named(const ShapesFile& file, const std::string& name) {
  for (const PlacedShape& s : file.shapes) {
    if (s.name == name) return s;
  }
  throw std::runtime_error("no shape " + name);
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
  const ShapesFile file = read_shapes(scenes / "gripper.urdf");
  EXPECT_EQ(file.name, "arm_with_gripper");
  EXPECT_EQ(file.shapes.size(), 7U);
  const auto& tube = std::get<Cylinder>(named(file, "upper_arm_link/tube").shape);
  EXPECT_EQ(tube.radius(), 0.06);
  EXPECT_EQ(tube.half_length(), 0.2);  // URDF gives the whole length
  // Turned by 0.6 about y at 0.1 m, then 0.2 m along it.
  const Pose& pose = named(file, "upper_arm_link/tube").pose;
  EXPECT_NEAR((pose.position() - Vec3(0.2 * std::sin(0.6), 0, 0.1 + 0.2 * std::cos(0.6))).norm(), 0,
              1e-12);
  EXPECT_NEAR((pose.axis() - Vec3(std::sin(0.6), 0, std::cos(0.6))).norm(), 0, 1e-12);
  EXPECT_TRUE(file.joined.contains({"palm_link", "camera_link"}));
}

TEST(Urdf, APercentSignDoesNotEndTheProcess) {
  const Written file("percent.urdf",
                     R"(<robot name="r"><link name="a"><collision><origin xyz="0%n 0 0"/><geometry>
                        <sphere radius="1"/></geometry></collision></link></robot>)");
  EXPECT_THROW(read_urdf(file.path), InvalidInput);
}

TEST(Urdf, SaysWhatItIgnores) {
  const auto ignored = read_urdf(scenes / "gripper.urdf").ignored;
  EXPECT_THAT(ignored, Contains("collision forearm_link/cover: a mesh"));
  EXPECT_THAT(ignored, Contains("joint elbow_joint: held in its default position"));
  EXPECT_THAT(ignored, Contains("transmission shoulder_transmission: not read"));
  EXPECT_THAT(ignored, Contains("gazebo forearm_link: not read"));
  EXPECT_EQ(ignored.size(), 8U);
}

TEST(Sdf, GivesShapesWhereTheyAreInTheWorld) {
  const ShapesFile file = read_shapes(scenes / "warehouse.sdf");
  EXPECT_EQ(file.name, "warehouse");
  EXPECT_EQ(file.shapes.size(), 9U);
  const PlacedShape& roller = named(file, "roller_conveyor::frame/roller_2");
  EXPECT_TRUE(roller.fixed);
  EXPECT_NEAR((roller.pose.position() - Vec3(-0.6, 0, 0.42)).norm(), 0, 1e-12);
  EXPECT_NEAR((roller.pose.axis() - Vec3(0, -1, 0)).norm(), 0, 1e-5);
  const auto& bumper = std::get<Capsule>(named(file, "cart::tray/bumper").shape);
  EXPECT_EQ(bumper.half_length(), 0.2);
  EXPECT_TRUE(std::holds_alternative<Plane>(named(file, "ground_plane::link/collision").shape));
  EXPECT_TRUE(file.joined.contains({"cart::tray", "cart::wheel"}));
}

TEST(Sdf, SaysWhatItIgnores) {
  const auto ignored = read_sdf(scenes / "warehouse.sdf").ignored;
  EXPECT_THAT(ignored, Contains(HasSubstr("collision cart::tray/hull: a mesh")));
  EXPECT_THAT(ignored, Contains("joint cart::wheel_axle: held in its default position"));
  EXPECT_THAT(ignored, Contains("plugin ignition::gazebo::systems::Physics: not read"));
  EXPECT_THAT(ignored, Contains("sensor touch: not read"));
}

TEST(RobotFiles, ThatAreBadAreRefused) {
  EXPECT_THROW(read_shapes("/nowhere/robot.urdf"), InvalidInput);
  EXPECT_THROW(read_shapes("/nowhere/world.sdf"), InvalidInput);
  const Written no_robot("robot.urdf", "<robot"), no_world("world.sdf", "<sdf version='1.7'>");
  EXPECT_THROW(read_shapes(no_robot.path), InvalidInput);
  EXPECT_THROW(read_shapes(no_world.path), InvalidInput);
  const Written flat("flat.urdf",
                     "<robot name='r'><link name='l'><collision name='c'><geometry>"
                     "<sphere radius='0'/></geometry></collision></link></robot>");
  try {
    read_shapes(flat.path);
    FAIL() << "accepted";
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("l/c.radius is 0"));
  }
}

/// Why a file with a collision "broken" of a link "mid" is refused.
std::string refusal_of(const std::string& name, const std::string& text) {
  const Written file(name, text);
  try {
    return fmt::format("accepted with {} shapes", read_shapes(file.path).shapes.size());
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
  EXPECT_THAT(urdf("r", "l\x1b[2J"), HasSubstr("must be without control characters"));
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

TEST(Urdf, LeavesItToTheReaderToSayWhyItIsNotXml) {
  EXPECT_THAT(refusal_of("part.urdf", "<robot name='r'><link"),
              HasSubstr("must be a URDF robot; the lines above say what is wrong"));
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
      return fmt::format("{} shapes", read_shapes(world.path).shapes.size());
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

}  // namespace
}  // namespace touchstone
