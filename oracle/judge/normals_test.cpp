#include "oracle/judge/normals.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "oracle/as_hull.hpp"
#include "oracle/judge/made_answers.hpp"

namespace touchstone {
namespace {

/// Answered with that normal, and the true depth.
Score along(const Configuration& c, const Vec3& n) {
  const oracle::Truth truth = oracle::truth(c);
  return score(c, truth, contact(truth.signed_distance.midpoint(), n), {});
}

/// A normal turned by `degrees` about an axis.
Vec3 turned(const Vec3& n, const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()) * n;
}

constexpr double angle_rounding = 1e-12;

TEST(NormalAngle, IsNoneForAnyMemberOfACircleAndElseTheAngleToIt) {
  // All directions across the axis tie.
  const Configuration c{Cylinder(1, 0.5), Pose(), Capsule(0.25, 2), Pose()};
  for (const double turn : {0.0, 30.0, 45.0, 81.9, 90.0, 200.0}) {
    const Vec3 member = turned(Vec3(1, 0, 0), Vec3(0, 0, 1), turn);
    EXPECT_NEAR(*along(c, member).normal_angle, 0, angle_rounding) << turn;
    const Vec3 off = turned(member, Vec3(0, 0, 1).cross(member), 0.5);
    EXPECT_NEAR(*along(c, off).normal_angle, 0.5, angle_rounding) << turn;
  }
}

TEST(NormalAngle, OfConcentricBodiesIsNoneForAPerfectAnswer) {
  const Configuration c{Cylinder(1, 0.5), Pose(), Capsule(1, 0.5), Pose()};
  for (const oracle::OptimalNormal& optimal : oracle::truth(c).normals) {
    EXPECT_EQ(*along(c, optimal.n).normal_angle, 0);
  }
  for (const Vec3& radial : {Vec3(0.6, 0.8, 0), Vec3(0, -1, 0), Vec3(-0.8, 0.6, 0)}) {
    EXPECT_NEAR(*along(c, radial).normal_regret, 0, 1e-15);
    EXPECT_EQ(*along(c, radial).normal_angle, 0);
  }
}

TEST(NormalAngle, IsNoneWithinAnArcAndBeyondItsEndsTheAngleToTheNearerOne) {
  // A rim that touches a box's edge exactly: all directions between those of the cap and the face.
  const Configuration c{Cylinder(1, 1), Pose(Vec3(0, 0, 2), {1, 0, 0, 0}), Box(Vec3(1, 1, 1)),
                        Pose(Vec3(2, 0, 0), {1, 0, 0, 0})};
  const oracle::Truth truth = oracle::truth(c);
  ASSERT_EQ(truth.ties, oracle::Ties::continuum);
  ASSERT_EQ(truth.families.size(), 1u);
  const oracle::NormalFamily& arc = truth.families[0];
  ASSERT_EQ(arc.kind, oracle::NormalFamily::Kind::arc);
  const Vec3 middle = (arc.ends[0] + arc.ends[1]).normalized();
  EXPECT_NEAR(*along(c, middle).normal_angle, 0, angle_rounding);
  EXPECT_NEAR(*along(c, turned(middle, middle.cross(arc.axis), 2)).normal_angle, 2, 1e-6);
  EXPECT_NEAR(*along(c, turned(arc.ends[1], arc.axis, 3)).normal_angle, 3, 1e-9);
}

/// The pose of an outside user: a cylinder that stands 0.1 mm deep on a floor of 200 m.
const Configuration on_floor{Cylinder(1, 1), Pose(Vec3(3, -2, 0.9999), {1, 0, 0, 0}),
                             Box(Vec3(100, 100, 1)), Pose(Vec3(0, 0, -1), {1, 0, 0, 0})};

TEST(FeltRegret, OfANormalOnAFloorIsThatOnAPlane) {
  const Configuration on_plane{on_floor.a, on_floor.pose_a, Plane(up, 0), Pose()};
  for (const double degrees : {4e-4, 0.01, 1.0, 30.0, 90.0}) {
    const Vec3 n = turned(up, Vec3(0.6, 0.8, 0), degrees);
    const Score floor = along(on_floor, n), plane = along(on_plane, n);
    // But for the depth, by which a turned normal comes out of a plane sooner.
    const double sooner = 1e-4 * (1 - std::cos(degrees * std::numbers::pi / 180));
    EXPECT_NEAR(*floor.normal_regret, *plane.normal_regret + sooner, 1e-12) << degrees;
    EXPECT_NEAR(*plane.normal_regret, *plane.whole_regret, 1e-12) << degrees;
    EXPECT_GT(*floor.whole_regret, 40 * *floor.normal_regret) << degrees;
  }
}

TEST(FeltRegret, JudgesTheSmallerBodyWhicheverItIs) {
  // A die on a table that is a cylinder.
  const Configuration table{Cylinder(100, 1), Pose(Vec3(0, 0, -1)), Box(Vec3(0.01, 0.01, 0.01)),
                            Pose(Vec3(40, 5, 0.00999), {1, 0, 0, 0})};
  for (const double degrees : {1e-3, 1.0}) {
    const Score s = along(table, turned(-up, Vec3(1, 0, 0), degrees));
    EXPECT_EQ(s.outcome == Outcome::wrong_normal, degrees == 1.0);
    EXPECT_LT(*s.normal_regret, 1e-3 * *s.whole_regret);
  }
}

TEST(FeltRegret, OfBodiesOfOneSizeIsThatOfTheWholeBodies) {
  const Configuration cans{Cylinder(0.5, 1), Pose(Vec3(0, 0, 1.999)), Cylinder(0.5, 1), Pose()};
  for (const double degrees : {1e-3, 0.1, 10.0, 90.0}) {
    const Score s = along(cans, turned(up, Vec3(1, 0, 0), degrees));
    EXPECT_EQ(s.normal_regret, s.whole_regret) << degrees;
  }
}

TEST(FeltRegret, OfANormalAcrossIsWrongHoweverDeepTheBodiesAre) {
  // Deeper than the cylinder is wide: across, the column beneath it would end sooner.
  const Configuration sunk{Cylinder(0.5, 0.5), Pose(Vec3(0, 0, -4)), Box(Vec3(100, 100, 50)),
                           Pose(Vec3(0, 0, -50), {1, 0, 0, 0})};
  EXPECT_EQ(along(sunk, Vec3(1, 0, 0)).outcome, Outcome::wrong_normal);
  EXPECT_EQ(along(sunk, -up).outcome, Outcome::wrong_normal);
  // All directions across the axis tie, and the one between them and the axis is none of them.
  const Configuration concentric{Cylinder(1, 1), Pose(), Sphere(1), Pose()};
  EXPECT_GT(*along(concentric, Vec3(0, 0.6, 0.8)).normal_regret, 0.3);
}

TEST(FeltRegret, OfABoxAsAHullIsThatOfTheBox) {
  // The hull's frame is anywhere; what a large whole regret leaves is felt.
  const Vec3 away(3, -1, 2);
  const Vec3 half(0.5, 0.25, 0.125);
  std::vector<Vec3> corners = as_hull(Box(half)).vertices();
  for (Vec3& v : corners) v += away;
  const Pose at({0.125, 0.25, 1.125}, {1, 0, 0, 0});
  const Configuration box{Cylinder(1, 1), Pose(), Box(half), at};
  const Configuration hull{box.a, box.pose_a, oracle::convex_hull(corners),
                           Pose(at.position() - away, at.orientation())};
  const oracle::Truth truth = oracle::truth(box);
  constexpr double whole = 1e3;
  for (const double degrees : {1e-3, 1.0, 60.0, 150.0}) {
    const Vec3 n = turned(truth.normals.front().n, Vec3(0.6, 0.8, 0), degrees);
    EXPECT_NEAR(felt_regret(hull, truth, n, whole), felt_regret(box, truth, n, whole), 1e-14);
  }
}

TEST(FeltRegret, OfANormalDoesNotGrowWithAFloor) {
  // 0.0004 degrees off are nothing to a can, a degree is much, on 20 m as on 20 km.
  for (const double half : {10.0, 100.0, 1e4}) {
    const Configuration c{on_floor.a, on_floor.pose_a, Box(Vec3(half, half, 1)), on_floor.pose_b};
    EXPECT_LT(*along(c, turned(up, Vec3(0, 1, 0), 4e-4)).normal_regret, 2e-5) << half;
    EXPECT_EQ(along(c, turned(up, Vec3(0, 1, 0), 1)).outcome, Outcome::wrong_normal) << half;
  }
}

}  // namespace
}  // namespace touchstone
