#include "oracle/audit/enclose.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "reference/invalid_input.hpp"

namespace touchstone::audit {
namespace {

using Quaternion = Eigen::Quaterniond;

const Quaternion upright(1, 0, 0, 0);
const Quaternion along_x(1, 0, 1, 0);  // norm² 2: only the ratio of the entries matters
const Quaternion along_y(1, -1, 0, 0);
const Quaternion tilted_7_24(4, 0, 3, 0);  // by arctan(24/7) about y

void expect_narrow_around(const Configuration& c, double exact) {
  const Enclosure e = enclose(c);
  EXPECT_LE(e.lo, exact);
  EXPECT_GE(e.hi, exact);
  EXPECT_LE(e.hi - e.lo, 1.0001e-9 * larger_size(c));
}

TEST(Enclose, CrossedCylindersInside) {
  expect_narrow_around(
      {Cylinder(1, 5), Pose({0, 0, 1.25}, along_x), Cylinder(0.5, 5), Pose({0, 0, 0}, along_y)},
      -0.25);
}

TEST(Enclose, CrossedCylindersThatTouchExactly) {
  expect_narrow_around(
      {Cylinder(1, 5), Pose({0, 0, 1.5}, along_x), Cylinder(0.5, 5), Pose({0, 0, 0}, along_y)}, 0);
}

TEST(Enclose, CapInsideCapOfAWiderCylinder) {
  expect_narrow_around({Cylinder(1, 1), Pose({0.25, 0, 2.75}, upright), Cylinder(2, 2), Pose()},
                       -0.25);
}

TEST(Enclose, CapsuleEndOverTheRimIsThreeFourFiveAway) {
  expect_narrow_around({Cylinder(1, 1), Pose(), Capsule(0.5, 1), Pose({4, 0, 6}, upright)}, 4.5);
}

TEST(Enclose, SphereInsideACylinderNearItsCap) {
  // Centre 1/4 below the cap: depth 1/4 + 1/2.
  expect_narrow_around({Cylinder(2, 1), Pose(), Sphere(0.5), Pose({0.5, 0, 0.75}, upright)}, -0.75);
}

TEST(Enclose, BoxEdgeAgainstTheSide) {
  expect_narrow_around({Cylinder(1, 3), Pose(), Box({1, 1, 1}), Pose({4, 5, 0}, upright)}, 4);
}

TEST(Enclose, BoxFaceAgainstACapInside) {
  expect_narrow_around({Cylinder(0.5, 1), Pose({0.1, 0.2, 1.875}, upright), Box({1, 1, 1}), Pose()},
                       -0.125);
}

TEST(Enclose, TiltedCylinderOverPlaneHasTheRimsHeight) {
  // sin = 24/25, cos = 7/25: height 3 − 2·7/25 − 1·24/25.
  expect_narrow_around({Cylinder(1, 2), Pose({0, 0, 3}, tilted_7_24), Plane({0, 0, 1}, 0), Pose()},
                       37.0 / 25);
}

TEST(Enclose, PlaneWhateverTheNormalsLength) {
  // 4 z <= 6 after a shift of the plane's frame by 1/2 along z: z <= 2.
  expect_narrow_around(
      {Cylinder(1, 1), Pose({5, 6, 2.5}, upright), Plane({0, 0, 4}, 6), Pose({7, 8, 0.5}, upright)},
      -0.5);
}

TEST(Enclose, AFamilyOfOptimalNormalsStaysWideButCertain) {
  // Every radial normal is optimal: depth 1 + 0.5.
  const Configuration c{Cylinder(1, 8), Pose(), Sphere(0.5), Pose({0, 0, 1}, upright)};
  const Enclosure e = enclose(c, {1e-9, 4000});
  EXPECT_LE(e.lo, -1.5);
  EXPECT_GE(e.hi, -1.5);
  EXPECT_LE(e.hi - e.lo, 1e-3);
  EXPECT_LE(e.cells, 4000);
}

TEST(Enclose, MoreCellsNeverWiden) {
  const Configuration c{Cylinder(0.3, 0.7), Pose({0.1, 0.05, 0.1}, Quaternion(3, 1, 2, 1)),
                        Cylinder(0.4, 0.2), Pose()};
  double width = HUGE_VAL;
  for (const int cells : {0, 10, 50, 200}) {
    const Enclosure e = enclose(c, {1e-12, cells});
    EXPECT_LE(e.hi - e.lo, width) << cells;
    width = e.hi - e.lo;
  }
}

TEST(Enclose, SeparatedBodiesNeedNoCell) {
  const Configuration c{Cylinder(0.3, 0.7), Pose({1.5, 0.25, 0.1}, Quaternion(3, 1, 2, 1)),
                        Box({0.4, 0.2, 0.3}), Pose()};
  const Enclosure e = enclose(c);
  EXPECT_EQ(e.cells, 0);
  EXPECT_EQ(e.hi, e.pair_distance);
  EXPECT_LE(e.pair_distance - e.lo, 1e-12);
}

TEST(Enclose, OverlappingBodiesShareAPoint) {
  const Configuration c{Cylinder(1, 1), Pose(), Sphere(1), Pose({0.5, 0.25, 0.1}, upright)};
  const Enclosure e = enclose(c);
  EXPECT_LE(e.pair_distance, 1e-12);
  EXPECT_LT(e.hi, 0);
}

TEST(Enclose, PowerOfTwoScalingScalesTheEnclosureExactly) {
  const double s = std::ldexp(1, -40);
  const Quaternion tilt(3, 1, 2, 1);
  const Enclosure one =
      enclose({Cylinder(0.3, 0.7), Pose({0.25, 0.25, 0.1}, tilt), Cylinder(0.4, 0.2), Pose()});
  const Enclosure small =
      enclose({Cylinder(0.3 * s, 0.7 * s), Pose(s * Vec3(0.25, 0.25, 0.1), tilt),
               Cylinder(0.4 * s, 0.2 * s), Pose()});
  EXPECT_EQ(one.lo * s, small.lo);
  EXPECT_EQ(one.hi * s, small.hi);
}

TEST(Enclose, SurvivesTheEndsOfTheDoubleRange) {
  const Configuration c{
      Cylinder(1e-300, 1e300), Pose({1e308, 0, 0}, Quaternion(1e-300, 1e300, 1, 0)),
      Box({5e-324, 1, 1e300}), Pose({-1e308, 1e-308, 0}, Quaternion(1, 1e-160, 0, 0))};
  const Enclosure e = enclose(c);
  EXPECT_GT(e.lo, 1e308);
  EXPECT_LE(e.lo, e.hi);
}

TEST(Enclose, RefusesAWidthThatIsNone) {
  const Configuration c{Cylinder(1, 1), Pose(), Sphere(1), Pose()};
  EXPECT_THROW(enclose(c, {0, 100}), InvalidInput);
  EXPECT_THROW(enclose(c, {std::nan(""), 100}), InvalidInput);
}

}  // namespace
}  // namespace touchstone::audit
