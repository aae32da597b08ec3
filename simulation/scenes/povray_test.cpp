// Scenes and runs as files for POV-Ray.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>

#include "properties/files/disk.hpp"
#include "properties/files/own_folder_test.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/robot_file.hpp"
#include "simulation/scenes/scene_file.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

struct PovrayTest : testing::Test {
  std::string text(const char* name) const { return read_file(folder / name, "file"); }
  const OwnFolder own;
  const std::filesystem::path& folder = own.path;
};

/// One frame: a box that lies on its side, moved.
SceneFile one_box() {
  SceneFile file;
  file.name = "box";
  Body body{"box", Box(Vec3(1, 2, 3))};
  body.pose = Pose(Vec3(4, 5, 6), Eigen::Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5)));
  file.scene.bodies = {body};
  file.camera = camera_for(file.scene);
  return file;
}
Trajectory one_frame(const SceneFile& file) {
  Trajectory run;
  run.step = 0.01;
  run.frames.emplace_back();
  for (const Body& b : file.scene.bodies) {
    run.frames[0].push_back({b.pose, Vec3::Zero(), Vec3::Zero()});
  }
  return run;
}

TEST_F(PovrayTest, RowsAreTheImagesOfTheAxes) {
  EXPECT_EQ(write_povray(one_box(), one_frame(one_box()), 0.04, folder), 1);
  // A quarter turn about z: x goes to y, y to −x.
  const std::string frame = text("frame-00001.inc");
  EXPECT_THAT(frame, HasSubstr("box { <-1,-2,-3>, <1,2,3>"));
  EXPECT_THAT(frame, testing::ContainsRegex("matrix <[^,]*,1,0, -1,[^,]*,0, 0,0,1, 4,5,6>"));
  EXPECT_THAT(text("scene.ini"), HasSubstr("Final_Frame=1"));
}

TEST_F(PovrayTest, AHullIsItsTriangles) {
  SceneFile file = one_box();
  file.scene.bodies[0].shape =
      Convex({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}, {{0, 1, 2, 3}, {3, 2, 1, 0}});
  write_povray(file, one_frame(file), 0.04, folder);
  EXPECT_THAT(text("frame-00001.inc"),
              HasSubstr("mesh { triangle { <0,0,0>, <1,0,0>, <1,2,0> } "
                        "triangle { <0,0,0>, <1,2,0>, <0,2,0> } "
                        "triangle { <0,2,0>, <1,2,0>, <1,0,0> } "
                        "triangle { <0,2,0>, <1,0,0>, <0,0,0> } Plain(<0.7,0.55,0.3>) matrix <"));
}

TEST_F(PovrayTest, EveryIsInSecondsOfTheScene) {
  const SceneFile file = one_box();
  Trajectory run = one_frame(file);
  run.frames.assign(11, run.frames[0]);
  EXPECT_EQ(write_povray(file, run, 0.05, folder), 3);  // at 0, 0.05 and 0.1 s
}

TEST_F(PovrayTest, FoldersThatAreNotThereAreRefused) {
  EXPECT_THROW(write_povray(one_box(), one_frame(one_box()), 0.04, folder / "none"), InvalidInput);
}

TEST_F(PovrayTest, PovrayDrawsAFrame) {
  if (std::system("command -v povray >/dev/null") != 0) GTEST_SKIP() << "povray is not installed";
  const SceneFile file = robot_scene(read_robot(TOUCHSTONE_SCENES "/warehouse.sdf"), {});
  write_povray(file, one_frame(file), 0.04, folder);
  const std::string command =
      "cd " + folder.string() + " && povray scene.ini +W64 +H48 >povray.log 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << text("povray.log");
  EXPECT_TRUE(std::filesystem::exists(folder / "scene.png")) << text("povray.log");
}

}  // namespace
}  // namespace touchstone
