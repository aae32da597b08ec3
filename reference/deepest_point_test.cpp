#include "deepest_point.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "reference/contact_of.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

const Quaternion upright(1, 0, 0, 0);
const Quaternion along_x(1, 0, 1, 0);
const Quaternion along_y(1, -1, 0, 0);

Vec3 only_point(const Configuration& c) {
  const Contact answer = contact(c, 0);
  EXPECT_EQ(answer.points().size(), 1u);
  return answer.points()[0].position;
}

TEST(DeepestPoint, OfCrossedCylindersLiesWhereTheAxesCross) {
  const Vec3 p = only_point(
      {Cylinder(1, 5), Pose({2, 0, 1.25}, along_x), Cylinder(0.5, 5), Pose({-1, 3, 0}, along_y)});
  EXPECT_LT((p - Vec3(-1, 0, 0.375)).norm(), 1e-14);
}

TEST(DeepestPoint, OfASideOverAFaceIsTheMiddleOfWhatTheFaceLeavesOfTheSide) {
  // The axis runs over the face's rectangle from x = −1 (its own end) to x = 2 (the face's edge).
  const Vec3 p =
      only_point({Cylinder(0.5, 2), Pose({1, 0.25, 1.25}, along_x), Box({2, 1, 1}), Pose()});
  EXPECT_LT((p - Vec3(0.5, 0.25, 0.875)).norm(), 1e-14);
}

TEST(DeepestPoint, OfACapOverAFacesCornerLiesOnBoth) {
  const Vec3 p =
      only_point({Cylinder(1, 1), Pose({2.5, 2.5, 1.75}, upright), Box({2, 2, 1}), Pose()});
  EXPECT_LE(std::max(p.x(), p.y()), 2);
  EXPECT_LE(std::hypot(p.x() - 2.5, p.y() - 2.5), 1);
  EXPECT_NEAR(p.z(), 0.875, 1e-15);
}

TEST(DeepestPoint, OfOverlappingCapsLiesOnBoth) {
  const Vec3 p =
      only_point({Cylinder(1, 1), Pose({2.5, 0, 1.75}, upright), Cylinder(2, 1), Pose()});
  EXPECT_LE(std::hypot(p.x(), p.y()), 2);
  EXPECT_LE(std::hypot(p.x() - 2.5, p.y()), 1);
}

}  // namespace
}  // namespace touchstone
