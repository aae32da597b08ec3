// Truths of rounded bodies: those of their cores, less the roundings, and those of the other shapes
// that they are.
#include <gtest/gtest.h>

#include "oracle/as_hull.hpp"
#include "oracle/expect_confirmed.hpp"
#include "oracle/rounded.hpp"
#include "oracle/rounding.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "reference/random_bodies_test.hpp"

namespace touchstone::oracle {
namespace {

class RoundedTruthOfPairs : public testing::TestWithParam<Pair> {};

/// Every fourth pose class.
template <class Expect>
void in_pose_classes(Pair pair, Expect expect) {
  const auto& classes = pose_classes(pair);
  for (std::size_t k = 0; k < classes.size(); k += 4) {
    const Identity id{pair, classes[k], 20261126, k};
    SCOPED_TRACE(to_string(id));
    expect(make_configuration(id));
  }
}

TEST_P(RoundedTruthOfPairs, IsThatOfTheCoresLessTheRoundings) {
  in_pose_classes(GetParam(), [](const Configuration& sharp) {
    const Configuration c = grown(sharp);
    const Truth rounded = truth(c), of_cores = truth(cores_of(c));
    const mpq_class by = mpq_class(c.a.rounding()) + mpq_class(rounding_of(c.b));
    EXPECT_LE(rounded.signed_distance.lo + by, of_cores.signed_distance.hi);
    EXPECT_GE(rounded.signed_distance.hi + by, of_cores.signed_distance.lo);
    constexpr double rounding = 1e-14;
    for (const OptimalNormal& n : rounded.normals) {
      EXPECT_LE(normal_regret(cores_of(c), of_cores, n.n), rounding * larger_size(c));
      EXPECT_LE(normal_regret(c, rounded, n.n), rounding * larger_size(c));
    }
  });
}

// The cores are discs, segments, points, and whatever lies between.
TEST_P(RoundedTruthOfPairs, OfAnyRoundingIsConfirmedByTheSecondOracle) {
  constexpr double parts[] = {0, 1e-9, 0.25, 0.75, 1};
  std::size_t k = 0;
  in_pose_classes(GetParam(), [&](const Configuration& sharp) {
    const Configuration c = rounded_by(sharp, parts[k % 5], parts[(k / 5) % 5]);
    ++k;
    const Truth t = truth(c);
    // Branch and bound ends late where a whole family of normals ties.
    const double width = t.ties == Ties::continuum ? 1e-4 : 1e-9;
    expect_confirmed(c, t, audit::Budget{}, width);
  });
}

INSTANTIATE_TEST_SUITE_P(, RoundedTruthOfPairs, testing::ValuesIn(all_pairs), name_of_other);

void expect_one_truth(const Configuration& c, const Configuration& d) {
  const Truth of_c = truth(c), of_d = truth(d);
  EXPECT_EQ(of_c.signed_distance.lo, of_d.signed_distance.lo);
  EXPECT_EQ(of_c.signed_distance.hi, of_d.signed_distance.hi);
  EXPECT_EQ(of_c.ties, of_d.ties);
}

/// Sums of floats are doubles.
double short_number(double x) { return static_cast<float>(x); }

TEST(RoundedTruth, OfACylinderRoundedByItsRadiusIsTheCapsules) {
  in_pose_classes(Pair::capsule, [](Configuration c) {
    const auto& given = std::get<Capsule>(c.b);
    const double r = short_number(given.radius()), h = short_number(given.half_length());
    c.b = Capsule(r, h);
    Configuration rounded = c;
    rounded.b = Cylinder(r, h + r, r);
    expect_one_truth(c, rounded);
  });
}

TEST(RoundedTruth, OfBodiesRoundedByAllOfTheirSizesIsTheSpheres) {
  in_pose_classes(Pair::sphere, [](const Configuration& c) {
    const double r = std::get<Sphere>(c.b).radius();
    for (const Shape& b : {Shape(Cylinder(r, r, r)), Shape(Box(Vec3(r, r, r), r))}) {
      expect_one_truth(c, {c.a, c.pose_a, b, c.pose_b});
    }
  });
}

TEST(RoundedTruth, OfARoundedBoxIsThatOfItsCoreAsARoundedHull) {
  in_pose_classes(Pair::box, [](const Configuration& sharp) {
    const Configuration c = grown(sharp);
    const auto& box = std::get<Box>(c.b);
    const Convex hull = as_hull(Box(box.core_half_extents())).rounded(box.rounding());
    expect_one_truth(c, {c.a, c.pose_a, hull, c.pose_b});
  });
}

// By hand, with all that touches: a rim of radius 1 about the core of a cylinder that is rounded by
// 1, over a box's corner and a sphere.
TEST(RoundedTruth, IsExactlyZeroWhereRoundEdgesTouch) {
  const Eigen::Quaterniond upright(1, 0, 0, 0);
  const Cylinder round(2, 2, 1);
  // The corner is at (4, 0, 5), 5 from the rim's point (1, 0, 1), of which both roundings leave 0.
  const Configuration at_corner{round, Pose(Vec3(0, 0, 0), upright), Box({8, 8, 8}, 4),
                                Pose(Vec3(8, 0, 9), upright)};
  const Configuration at_sphere{round, Pose(Vec3(0, 0, 0), upright), Sphere(4),
                                Pose(Vec3(4, 0, 5), upright)};
  const Configuration on_plane{round, Pose(Vec3(0, 0, 2), upright), Plane({0, 0, 1}, 0), Pose()};
  for (const Configuration& c : {at_corner, at_sphere, on_plane}) {
    const Truth t = truth(c);
    EXPECT_EQ(t.signed_distance.lo, 0);
    EXPECT_EQ(t.signed_distance.hi, 0);
    EXPECT_EQ(t.ties, Ties::unique);
  }
}

TEST(RoundedTruth, ChangesByNoMoreThanRoundedNumbersDo) {
  in_pose_classes(Pair::box, [](const Configuration& sharp) {
    const Configuration c = rounded_by(sharp, 0.3, 0.7);
    const Truth exact = truth(c);
    for (const int bits : {20, 30, 50}) {
      const RoundedConfiguration rounded = rounded_configuration(c, bits);
      EXPECT_LE(rounded.configuration.a.rounding(), smallest_half_extent(rounded.configuration.a));
      const mpq_class off =
          truth(rounded.configuration).signed_distance.lo - exact.signed_distance.lo;
      EXPECT_LE(abs(off), rounded.error + mpq_class(1e-25) * mpq_class(larger_size(c)));
    }
  });
}

// Segments that cross are as deep as their roundings, along their common perpendicular.
TEST(RoundedTruth, OfCapsulesThatCrossIsTheSumOfTheirRadii) {
  const Eigen::Quaterniond upright(1, 0, 0, 0), lying(1, 1, 0, 0);
  const Truth t = truth({Cylinder(1, 3, 1), Pose(Vec3::Zero(), upright), Cylinder(2, 5, 2),
                         Pose(Vec3::Zero(), lying)});
  EXPECT_NEAR(t.signed_distance.midpoint(), -3, 1e-15);
  for (const OptimalNormal& n : t.normals) EXPECT_NEAR(std::abs(n.n.x()), 1, 1e-15);
}

}  // namespace
}  // namespace touchstone::oracle
