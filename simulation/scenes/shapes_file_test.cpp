#include "simulation/scenes/shapes_file.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <unistd.h>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"
#include "reports/choice/shape_pairs.hpp"

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

TEST(RobotFiles, HaveTheirPairsScored) {
  PairNeeds needs;
  needs.count = 20;
  const auto choose = [&] {
    return choose_for_pairs(read_shapes(scenes / "warehouse.sdf"), needs,
                            find_candidates({"capsule"}), {}, "", "out");
  };
  const nlohmann::json choice = choose();
  // Not the wheel with the tray, which a joint holds, nor rollers with what is fixed as they are.
  for (const auto& pair : choice["pairs"]) {
    const std::string example = pair["example"].get<std::string>();
    EXPECT_FALSE(example.find("tyre") < example.size() && example.find("deck") < example.size());
    EXPECT_FALSE(example.find("roller") < example.size() &&
                 example.find("ground") < example.size());
    EXPECT_FALSE(pair["chosen"].is_null()) << example;
    for (const auto& c : pair["candidates"]) {
      if (c["name"] == "reference") {
        EXPECT_LT(c["depth_error"].get<double>(), 1e-12);
      }
    }
  }
  const nlohmann::json again = choose();
  EXPECT_EQ(choice["pairs"][0]["candidates"][0]["depth_error"],
            again["pairs"][0]["candidates"][0]["depth_error"]);
}

}  // namespace
}  // namespace touchstone
