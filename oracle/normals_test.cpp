// All optimal normals: their alignment to the bodies' axes, and their families.
#include <cmath>
#include <gtest/gtest.h>

#include "oracle/brute_force.hpp"
#include "oracle/truth.hpp"

namespace touchstone::oracle {
namespace {

using Quaternion = Eigen::Quaterniond;
using enum Alignment;
using To = std::array<Alignment, 3>;

const Quaternion upright(1, 0, 0, 0), along_x(1, 0, 1, 0), tilted_7_24(4, 0, 3, 0);

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

}  // namespace
}  // namespace touchstone::oracle
