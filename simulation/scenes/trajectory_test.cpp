// What is printed of a run.
#include "simulation/scenes/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

using testing::HasSubstr;

/// A can that begins in the origin, beside a floor, and where it ends.
std::string table_of(const Vec3& end, bool is_fixed) {
  Scene scene;
  scene.bodies = {{.name = "floor", .shape = Plane(Vec3::UnitZ(), -1), .fixed = true},
                  {.name = "can", .shape = Cylinder(0.1, 0.2), .fixed = is_fixed}};
  Trajectory run;
  run.step = 0.1;
  for (const Vec3& place : {Vec3(0, 0, 0), end}) {
    run.frames.push_back(
        {{Pose(), Vec3::Zero(), Vec3::Zero()}, {Pose(place), Vec3::Zero(), Vec3::Zero()}});
  }
  return motion_table(scene, run);
}

TEST(MotionTable, TellsMicrometresApart) {
  const std::string text = table_of(Vec3(-1234.567891, 0.000123, 1e-6), false);
  EXPECT_THAT(text, HasSubstr("can    -1234.567891   0.000123   0.000001  1234.567891"));
  EXPECT_THAT(text, testing::Not(HasSubstr("floor")));
}

TEST(MotionTable, SaysThatNothingMoves) {
  EXPECT_EQ(table_of(Vec3(0, 0, 0), true), "  Nothing moves: all is fixed.\n");
}

TEST(ShapeText, TellsHullsApart) {
  const Convex wedge({{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {0, 0, 0.5}},
                     {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  EXPECT_EQ(shape_text(wedge), "convex 2×4×0.5 of 4 corners");
}

}  // namespace
}  // namespace touchstone
