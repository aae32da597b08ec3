#include "oracle/judge/point_distance.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(PointDistance, OfEveryShape) {
  const Pose at({1, 2, 3}, {1, 0, 0, 0});
  const auto distance = [&](const Shape& s, const Vec3& p) { return point_distance(s, at, p); };
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {4, 2, 3}), 2);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {5, 2, 9}), 5);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {1.25, 2, 3}), -0.75);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {1, 2, 4.5}), -0.5);
  EXPECT_DOUBLE_EQ(distance(Capsule(1, 2), {1, 2, 7}), 1);
  EXPECT_DOUBLE_EQ(distance(Capsule(1, 2), {1, 2, 3}), -1);
  EXPECT_DOUBLE_EQ(distance(Sphere(1), {1, 2, 5}), 1);
  EXPECT_DOUBLE_EQ(distance(Box({1, 1, 1}), {5, 2, 7}), std::hypot(3, 3));
  EXPECT_DOUBLE_EQ(distance(Box({1, 2, 3}), {1, 2, 3}), -1);
  EXPECT_DOUBLE_EQ(distance(Plane({0, 0, 2}, 2), {0, 0, 5}), 1);
}

/// A can standing 0.2 deep in a half-space.
const Configuration standing{Cylinder(1, 2), Pose({0, 0, 1.8}, {1, 0, 0, 0}), Plane({0, 0, 1}, 0),
                             Pose()};

double excess(const Vec3& p, double depth) {
  return point_excess(standing, {{p.x(), p.y(), p.z()}, {0, 0, 1}, depth});
}

TEST(PointExcess, IsNoneBetweenTheSurfacesWhereverInTheDepth) {
  for (const double z : {-0.2, -0.1, 0.0}) EXPECT_LE(excess({0.5, 0, z}, 0.2), 1e-15) << z;
  EXPECT_LT(excess({0.5, 0, -0.1}, 0.2), 0);
}

TEST(PointExcess, MeasuresFromTheFartherSurface) {
  EXPECT_NEAR(excess({3, 0, 0}, 0.2), std::hypot(2, 0.0) - 0.2, 1e-15);
  // 0.7 above the half-space, 0.9 from the cap below it.
  EXPECT_NEAR(excess({0, 0, 0.7}, 0.2), 0.7, 1e-15);
  EXPECT_NEAR(excess({0, 0, 0.7}, -0.2), 0.7, 1e-15);  // points apart have negative depths
}

}  // namespace
}  // namespace touchstone
