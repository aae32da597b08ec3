// One test for each rule without which the set of critical directions is incomplete or its
// enclosure does not converge, with a configuration that needs the rule (oracle/README.md).
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "oracle/brute_force.hpp"
#include "oracle/truth.hpp"
#include "properties/moves.hpp"

namespace touchstone::oracle {
namespace {

using Quaternion = Eigen::Quaterniond;

/// The integer quaternion of a rotation matrix with entries integer / denominator, exactly.
Quaternion exact_quaternion(const Eigen::Matrix3d& m, double denominator) {
  // Shepperd's first case, times 4w times the denominator; w must not be zero.
  Quaternion q(denominator + m.trace(), m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
  EXPECT_GT(q.w(), 0);
  return q;
}

/// A cylinder of radius and half length 125 with a rim point at P whose outward radial direction,
/// tangent and axis (towards that rim) are columns / 125.
Configuration rims_meet_at(const Vec3& p, const Eigen::Matrix3d& radial_tangent_axis) {
  const Vec3 radial = radial_tangent_axis.col(0), axis = radial_tangent_axis.col(2);
  return {Cylinder(100, 100), Pose(), Cylinder(125, 125),
          Pose(p - radial - axis, exact_quaternion(radial_tangent_axis, 125))};
}

Eigen::Matrix3d columns(const Vec3& a, const Vec3& b, const Vec3& c) {
  Eigen::Matrix3d m;
  m << a, b, c;
  return m;
}

void expect_zero(const Configuration& c) {
  const Truth t = truth(c);
  EXPECT_LE(t.signed_distance.lo, 0);
  EXPECT_GE(t.signed_distance.hi, 0);
  expect_brute_force_agrees(c, t);
}

// Rule 1: the difference of the points vanishes, the tangents' cross product does not.
TEST(Completeness, TouchingRimsWithCrossedTangentsHaveTheTangentsNormal) {
  // n = (3, 0, 4)/5 is outward at A's rim point (100, 0, 100), whose tangent is y.
  const Vec3 n = Vec3(3, 0, 4) / 5;
  const Vec3 t2 = Vec3(12, 20, -9) / 25;
  const Vec3 m = n.cross(t2);
  // −n = (4 radial + 3 axis)/5
  const Vec3 radial = (-4 * n - 3 * m) / 5, axis = (-3 * n + 4 * m) / 5;
  Eigen::Matrix3d frame = 625 * columns(radial, axis.cross(radial), axis);
  frame = (frame.array().round() / 5).matrix();  // integers / 125 once rounding is taken off
  ASSERT_TRUE((frame.array() == frame.array().round()).all());
  const Configuration c = rims_meet_at({100, 0, 100}, frame);
  expect_zero(c);
  EXPECT_LT((truth(c).normals.at(0).n + n).norm(), 1e-6);
}

// Found among 40,000 configurations of small integers: at θ = π/2 everything is exact, the zero
// included.
TEST(Completeness, RimsThatTouchExactlyWithoutAContactDoNotHoldUpTheEnclosure) {
  const Configuration c{Cylinder(1.5, 0.5), Pose({-0.5, -1.5, -1.5}, Quaternion(2, -1, 0, 0)),
                        Cylinder(0.5, 2), Pose({0, 0, 0}, Quaternion(1, 1, 0, 0))};
  const Truth t = truth(c);
  EXPECT_LE(t.signed_distance.lo, mpq_class(-3, 10));
  EXPECT_GE(t.signed_distance.hi, mpq_class(-3, 10));
  expect_brute_force_agrees(c, t);
}

// Rule 3: the tangents do not help either.
TEST(Completeness, TouchingRimsWithParallelTangentsAreZeroAlongAnArcOfNormals) {
  const Configuration c =
      rims_meet_at({100, 0, 100}, columns(Vec3(-100, 0, -75), Vec3(0, 125, 0), Vec3(75, 0, -100)));
  expect_zero(c);
  EXPECT_EQ(truth(c).ties, Ties::continuum);
}

TEST(Completeness, RimsThatMeetInsideABodyDoNotMakeItsDistanceZero) {
  const Configuration c =
      rims_meet_at({100, 0, 100}, columns(Vec3(100, 0, 75), Vec3(0, 125, 0), Vec3(-75, 0, 100)));
  const Truth t = truth(c);
  EXPECT_LT(t.signed_distance.hi, -50);
  expect_brute_force_agrees(c, t);
}

// Rule 2: a point of A's rim on B's axis has all of B's rim at one distance.
TEST(Completeness, RimPointOnTheOtherAxisIsNoExcuse) {
  const Vec3 rim(1, 0, 1);
  for (const auto& turn : {Quaternion(4, 0, 3, 0), Quaternion(3, 1, 2, 1), Quaternion(1, 1, 0, 0),
                           Quaternion(1, 0, 1, 0), Quaternion(2, -1, 0, 2)}) {
    for (const double along : {-1.5, -1.0, -0.25, 0.0, 0.5, 1.0}) {
      for (const double radius : {0.25, 1.0, 4.0}) {
        // The axis of an integer quaternion is rational; times norm² it is exact.
        const Vec3 axis = turn.squaredNorm() * (turn.normalized() * Vec3::UnitZ());
        const Vec3 exact_axis(std::round(axis.x()), std::round(axis.y()), std::round(axis.z()));
        const Configuration c{Cylinder(1, 1), Pose(), Cylinder(radius, 0.5 * turn.squaredNorm()),
                              Pose(rim + along * exact_axis, turn)};
        SCOPED_TRACE(std::to_string(along) + " " + std::to_string(radius));
        expect_brute_force_agrees(c, truth(c));
      }
    }
  }
}

// Rule 4: multiple roots in all polynomials.
TEST(Completeness, ConcentricBodies) {
  for (const auto& turn : {Quaternion(4, 0, 3, 0), Quaternion(3, 1, 2, 1), Quaternion(1, 0, 1, 0),
                           Quaternion(1, 1e-7, 0, 0), Quaternion(1, 0, 0, 0)}) {
    for (const Shape& b : {Shape(Cylinder(0.5, 2)), Shape(Cylinder(1, 1)), Shape(Box({1, 1, 1})),
                           Shape(Box({0.25, 1, 3})), Shape(Capsule(0.5, 1))}) {
      const Configuration c{Cylinder(1, 1), Pose(), b, Pose({0, 0, 0}, turn)};
      SCOPED_TRACE(shape_name(b));
      expect_brute_force_agrees(c, truth(c));
    }
  }
}

// Rule 5: polynomials that vanish identically.
TEST(Completeness, DiscCentredOnACornerWithPerpendicularAxes) {
  // B's cap is centred on A's rim point, its axis along A's tangent or across it.
  for (const auto& turn : {along_x, Quaternion(1, 1, 0, 0)}) {
    const Configuration cylinders{Cylinder(1, 1), Pose(), Cylinder(0.5, 1), Pose({1, 1, 1}, turn)};
    expect_brute_force_agrees(cylinders, truth(cylinders));
    const Configuration on_rim{Cylinder(1, 1), Pose(), Cylinder(0.5, 1), Pose({2, 0, 1}, turn)};
    expect_brute_force_agrees(on_rim, truth(on_rim));
    const Configuration box{Cylinder(1, 1), Pose({2, 0, 0}, turn), Box({1, 1, 1}), Pose()};
    expect_brute_force_agrees(box, truth(box));
  }
}

TEST(Completeness, SegmentEndOnAnEdgeOfADiscSeenEdgeOn) {
  // Across the box's y edge A's cap is a segment whose end touches the edge.
  const Configuration c{Cylinder(1, 1), Pose({1, 0, 3}, Quaternion(1, 0, 0, 0)), Box({2, 2, 2}),
                        Pose()};
  const Configuration corner{Cylinder(1, 1), Pose({3, 0, 3}, Quaternion(1, 0, 0, 0)),
                             Box({2, 2, 2}), Pose()};
  expect_brute_force_agrees(c, truth(c));
  expect_zero(corner);
}

TEST(Completeness, VillarceauCirclesKeepTheirDistance) {
  // Two equal rims of one torus: the distance from a rim's point to the other rim is constant on
  // such families; whichever wins, no direction may beat it.
  for (const double radius : {1.0, 2.0}) {
    const Configuration c{Cylinder(radius, 1), Pose(), Cylinder(radius, 1),
                          Pose({0, 1, 0}, Quaternion(4, 3, 0, 0))};
    expect_brute_force_agrees(c, truth(c));
  }
}

// Rule 6: roots 2^-70 apart.
TEST(Completeness, NearlyParallelAxes) {
  for (int k = 1; k <= 15; ++k) {
    SCOPED_TRACE(k);
    const Quaternion tilt(1, std::pow(10, -k), 0, 0);
    const Configuration side{Cylinder(0.5, 1), Pose({0.75, 0.5, 0.25}, tilt), Cylinder(0.5, 0.75),
                             Pose()};
    expect_brute_force_agrees(side, truth(side));
    const Configuration cap{Cylinder(0.5, 1), Pose({0.25, 0.5, 1.75}, tilt), Cylinder(0.5, 0.75),
                            Pose()};
    expect_brute_force_agrees(cap, truth(cap));
    const Configuration box{Cylinder(0.5, 1), Pose({0.25, 0.5, 1.75}, tilt), Box({0.5, 0.5, 0.75}),
                            Pose()};
    expect_brute_force_agrees(box, truth(box));
  }
}

}  // namespace
}  // namespace touchstone::oracle
