// What the truth says of gaps, alignments, families and ties, and the rules that completeness
// needs; signed distances on paper are in closed_forms_test.cpp.
#include "oracle/truth.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <string>

#include "oracle/expect_confirmed.hpp"
#include "properties/moves.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

using Quaternion = Eigen::Quaterniond;

/// Turns by arctan(24/7) about y: 2·atan(3/4), exactly, since only the ratio of an integer
/// quaternion's entries matters.
const Quaternion tilted_7_24(4, 0, 3, 0);

TEST(Truth, ExactWhateverTheQuaternionsLength) {
  const Configuration one{Cylinder(0.3, 0.7), Pose({1, 0, 0}, Quaternion(1, 2, 3, 4)),
                          Box({0.2, 0.3, 0.4}), Pose({0, 0, 0}, Quaternion(5, -1, 2, 2))};
  const Configuration other{
      Cylinder(0.3, 0.7), Pose({1, 0, 0}, Quaternion(-1024, -2048, -3072, -4096)),
      Box({0.2, 0.3, 0.4}), Pose({0, 0, 0}, Quaternion(0.625, -0.125, 0.25, 0.25))};
  const Enclosure x = truth(one).signed_distance, y = truth(other).signed_distance;
  EXPECT_EQ(x.lo, y.lo);
  EXPECT_EQ(x.hi, y.hi);
}

// Gap and regret.

TEST(Gap, AlongTheOptimalNormalIsTheSignedDistance) {
  const Configuration c{Cylinder(1, 1), Pose(), Sphere(2), Pose({4, 0, 5}, upright)};
  const Enclosure g = certified_gap(c, Vec3(-3, 0, -4));  // any length
  EXPECT_LE(g.lo, 3);
  EXPECT_GE(g.hi, 3);
  EXPECT_EQ(normal_regret(c, truth(c), Vec3(-3, 0, -4)), 0);
}

TEST(Gap, ReversedNormalRegretsTwiceTheCentresDistanceAlongIt) {
  const Configuration c{Cylinder(1, 1), Pose({0, 0, 4}, upright), Sphere(1), Pose()};
  EXPECT_NEAR(normal_regret(c, truth(c), Vec3(0, 0, -1)), 8, 1e-14);
}

TEST(Gap, TiltedNormalOnAPlaneCostsToFirstOrderInTheAngle) {
  const Configuration c{Cylinder(3, 4), Pose({0, 0, 4}, upright), Plane({0, 0, 1}, 0), Pose()};
  // D = 4, circumradius 5: regret is h_A(n) − h_A(N) + 5 sin α + D (1 − cos α), h_A = 4 cos + 3
  // sin.
  const double s = 0.6, co = 0.8;
  EXPECT_NEAR(normal_regret(c, truth(c), Vec3(s, 0, co)),
              (4 * co + 3 * s) - 4 + 5 * s + 4 * (1 - co), 1e-14);
  EXPECT_EQ(normal_regret(c, truth(c), Vec3(0, 0, 1)), 0);
  EXPECT_GT(normal_regret(c, truth(c), Vec3(0, 0, -1)), 8);
}

TEST(Gap, RegretIsWhatExactFractionsSayRoundedTowardsZero) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (int i = 0; i < 300; ++i) {
    const Quaternion turn(normal(random), normal(random), normal(random), normal(random));
    const Configuration c{Cylinder(1, 2), Pose(vector(), turn), Box(Vec3(1, 0.1, 3)), Pose()};
    const Truth t = truth(c);
    Regrets regrets(c, t);
    const Vec3 right = t.normals.front().n;
    for (const Vec3& n : {vector(), right, Vec3(right + 1e-9 * vector())}) {
      const Enclosure g = regrets.gap(n);
      EXPECT_LT(g.width(), 1e-30);  // of the first precision
      const mpq_class regret = (t.signed_distance.lo + t.signed_distance.hi - g.lo - g.hi) / 2;
      EXPECT_EQ(regrets.of(n), std::max(0.0, regret.get_d()));
      EXPECT_EQ(regrets.of(n), regrets.of(n));
    }
  }
}

TEST(Gap, RefusesWhatIsNoDirection) {
  const Configuration c{Cylinder(1, 1), Pose(), Sphere(1), Pose()};
  EXPECT_THROW(certified_gap(c, Vec3::Zero()), InvalidInput);
  EXPECT_THROW(certified_gap(c, Vec3(0, std::nan(""), 1)), InvalidInput);
}

using enum Alignment;
using To = std::array<Alignment, 3>;

void expect_alignment(const Configuration& c, Alignment to_a, const To& to_b) {
  const Truth t = truth(c);
  ASSERT_EQ(t.normals.size(), 1u);
  EXPECT_EQ(t.normals[0].to_a, to_a);
  EXPECT_EQ(t.normals[0].to_b, to_b);
}

TEST(Alignment, SaysWhichFeaturesMeet) {
  const Cylinder a(1, 1);
  // Cap on cap, side on side, caps' rims on a face and on a side.
  expect_alignment({a, Pose({0.5, 0, 1.75}, upright), Cylinder(1, 1), Pose()}, parallel,
                   {oblique, oblique, parallel});
  expect_alignment({a, Pose({1.75, 0, 0.5}, upright), Cylinder(1, 1), Pose()}, perpendicular,
                   {oblique, oblique, perpendicular});
  expect_alignment({a, Pose({0, 0, 2.5}, tilted_7_24), Box({4, 4, 1}), Pose()}, oblique,
                   {perpendicular, perpendicular, parallel});
  expect_alignment({a, Pose({0, 0, 1.75}, along_x), Box({4, 4, 1}), Pose()}, perpendicular,
                   {perpendicular, perpendicular, parallel});
  // Side on a box's edge: the edge is along y.
  expect_alignment({a, Pose({1.6, 0.25, 1.7}, Quaternion(1, 1, 0, 0)), Box({1, 4, 1}), Pose()},
                   perpendicular, {oblique, perpendicular, oblique});
  // Crossed sides.
  expect_alignment({Cylinder(1, 4), Pose({0, 0, 1.75}, along_x), Capsule(1, 4),
                    Pose({0, 0, 0}, Quaternion(1, 1, 0, 0))},
                   perpendicular, {oblique, oblique, perpendicular});
}

TEST(Alignment, IsExactNotATolerance) {
  // An edge-on tilt of 2^-40: the cap's rim, not the cap, meets the face.
  const Configuration c{Cylinder(1, 1), Pose({0, 0, 1.75}, Quaternion(1, 0x1p-40, 0, 0)),
                        Box({4, 4, 1}), Pose()};
  expect_alignment(c, oblique, {perpendicular, perpendicular, parallel});
}

TEST(Families, CoaxialCylindersHaveTheWholeCircle) {
  const Truth t = truth({Cylinder(1, 8), Pose({0, 0, 1}, upright), Cylinder(0.5, 8), Pose()});
  ASSERT_EQ(t.families.size(), 1u);
  EXPECT_EQ(t.families[0].kind, NormalFamily::Kind::circle);
  EXPECT_NEAR(std::abs(t.families[0].axis.z()), 1, 1e-15);
}

TEST(Families, ASphereCentredOnTheRimHasTheQuarterArcOfItsNormals) {
  const Truth t = truth({Cylinder(1, 1), Pose(), Sphere(0.25), Pose({1, 0, 1}, upright)});
  ASSERT_EQ(t.families.size(), 1u);
  const NormalFamily& arc = t.families[0];
  ASSERT_EQ(arc.kind, NormalFamily::Kind::arc);
  EXPECT_NEAR(arc.ends.at(0).dot(arc.ends.at(1)), 0, 1e-15);
  EXPECT_LT((arc.axis - arc.ends[0].cross(arc.ends[1])).norm(), 1e-14);
  for (const Vec3& end : arc.ends) EXPECT_TRUE(end == Vec3(-1, 0, 0) || end == Vec3(0, 0, -1));
}

TEST(Families, ABoxCornerOnTheRimTouchesAlongAnArc) {
  // The box's vertical edge passes the rim's point, its lower corner lies on it.
  const Truth t = truth({Cylinder(1, 1), Pose(), Box({1, 1, 1}), Pose({2, 1, 2}, upright)});
  EXPECT_EQ(t.signed_distance.lo, 0);
  EXPECT_EQ(t.signed_distance.hi, 0);
  ASSERT_EQ(t.families.size(), 1u);
  EXPECT_EQ(t.families[0].kind, NormalFamily::Kind::arc);
}

TEST(Normals, WithinATieAreAllTheCriticalOnes) {
  // A coin's caps are 0.5 and 0.75 away from a small sphere's centre, its side 4.
  const Configuration c{Cylinder(4, 0.625), Pose(), Sphere(0.25), Pose({0, 0, 0.125}, upright)};
  EXPECT_EQ(truth(c).normals.size(), 1u);
  EXPECT_EQ(truth(c, 1e-30, 0.05).normals.size(), 1u);
  const Truth both = truth(c, 1e-30, 0.1);
  ASSERT_EQ(both.normals.size(), 2u);
  EXPECT_EQ(both.ties, Ties::finite);
  EXPECT_EQ(both.normals[0].n, -both.normals[1].n);
}

TEST(Normals, TieWhereTheirGapsDifferByLessThanAMillionthOfTheWidth) {
  // A sphere beside a coin's middle by z: the gaps along the caps differ by 2 z.
  const auto coin = [](double z, double width) {
    return truth({Cylinder(1, 0.5), Pose(), Sphere(0.25), Pose({0, 0, z}, upright)}, width);
  };
  for (const double width : {1e-30, 1e-13, 1e-50}) {
    const double tie = std::ldexp(width, -20);
    // The last is less than the first working precision resolves.
    for (const double beside : {0.02, 0x1p-20, 0x1p-45}) {
      const double within = (1 - beside) / 2 * tie, beyond = (1 + beside) / 2 * tie;
      EXPECT_EQ(coin(within, width).ties, Ties::finite) << width << ' ' << beside;
      EXPECT_EQ(coin(-within, width).normals.size(), 2u) << width << ' ' << beside;
      EXPECT_EQ(coin(beyond, width).ties, Ties::unique) << width << ' ' << beside;
      EXPECT_EQ(coin(-beyond, width).normals.size(), 1u) << width << ' ' << beside;
    }
  }
}

TEST(Normals, RefuseATieThatIsNone) {
  const Configuration c{Cylinder(1, 1), Pose(), Sphere(1), Pose()};
  EXPECT_ANY_THROW(truth(c, 1e-30, -1));
  EXPECT_ANY_THROW(truth(c, 1e-30, NAN));
}

// One test for each rule without which the set of critical directions is incomplete or its
// enclosure does not converge, with a configuration that needs the rule (oracle/truth.md).

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
  expect_confirmed(c, t);
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
  expect_confirmed(c, t);
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
  expect_confirmed(c, t);
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
        expect_confirmed(c, truth(c));
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
      expect_confirmed(c, truth(c));
    }
  }
}

// Rule 5: polynomials that vanish identically.
TEST(Completeness, DiscCentredOnACornerWithPerpendicularAxes) {
  // B's cap is centred on A's rim point, its axis along A's tangent or across it.
  for (const auto& turn : {along_x, Quaternion(1, 1, 0, 0)}) {
    const Configuration cylinders{Cylinder(1, 1), Pose(), Cylinder(0.5, 1), Pose({1, 1, 1}, turn)};
    expect_confirmed(cylinders, truth(cylinders));
    const Configuration on_rim{Cylinder(1, 1), Pose(), Cylinder(0.5, 1), Pose({2, 0, 1}, turn)};
    expect_confirmed(on_rim, truth(on_rim));
    const Configuration box{Cylinder(1, 1), Pose({2, 0, 0}, turn), Box({1, 1, 1}), Pose()};
    expect_confirmed(box, truth(box));
  }
}

TEST(Completeness, SegmentEndOnAnEdgeOfADiscSeenEdgeOn) {
  // Across the box's y edge A's cap is a segment whose end touches the edge.
  const Configuration c{Cylinder(1, 1), Pose({1, 0, 3}, Quaternion(1, 0, 0, 0)), Box({2, 2, 2}),
                        Pose()};
  const Configuration corner{Cylinder(1, 1), Pose({3, 0, 3}, Quaternion(1, 0, 0, 0)),
                             Box({2, 2, 2}), Pose()};
  expect_confirmed(c, truth(c));
  expect_zero(corner);
}

TEST(Completeness, VillarceauCirclesKeepTheirDistance) {
  // Two equal rims of one torus: the distance from a rim's point to the other rim is constant on
  // such families; whichever wins, no direction may beat it.
  for (const double radius : {1.0, 2.0}) {
    const Configuration c{Cylinder(radius, 1), Pose(), Cylinder(radius, 1),
                          Pose({0, 1, 0}, Quaternion(4, 3, 0, 0))};
    expect_confirmed(c, truth(c));
  }
}

// Rule 6: roots 2^-70 apart.
TEST(Completeness, NearlyParallelAxes) {
  for (int k = 1; k <= 15; ++k) {
    SCOPED_TRACE(k);
    const Quaternion tilt(1, std::pow(10, -k), 0, 0);
    const Configuration side{Cylinder(0.5, 1), Pose({0.75, 0.5, 0.25}, tilt), Cylinder(0.5, 0.75),
                             Pose()};
    expect_confirmed(side, truth(side));
    const Configuration cap{Cylinder(0.5, 1), Pose({0.25, 0.5, 1.75}, tilt), Cylinder(0.5, 0.75),
                            Pose()};
    expect_confirmed(cap, truth(cap));
    const Configuration box{Cylinder(0.5, 1), Pose({0.25, 0.5, 1.75}, tilt), Box({0.5, 0.5, 0.75}),
                            Pose()};
    expect_confirmed(box, truth(box));
  }
}

}  // namespace
}  // namespace touchstone::oracle
