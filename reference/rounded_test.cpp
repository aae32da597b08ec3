// Our routine's answers about rounded bodies: those of the exact truth, and points that keep their
// promises. The cores are sharp bodies, discs, segments and points.
#include "oracle/rounded.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "oracle/as_hull.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "reference/batch.hpp"
#include "reference/contact_of.hpp"
#include "reference/points_on_both_test.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

/// Every fourth pose class, with roundings of all parts.
std::vector<Configuration> rounded_bodies(Pair pair) {
  constexpr double parts[] = {0, 1e-9, 0.25, 0.75, 1};
  const bool is_hull = pair == Pair::convex;
  const auto& classes = pose_classes(is_hull ? Pair::box : pair);
  std::vector<Configuration> result;
  for (std::size_t k = 0; k < classes.size(); k += 4) {
    const Configuration c =
        make_configuration({is_hull ? Pair::box : pair, classes[k], 20261126, k});
    result.push_back(rounded_by(is_hull ? with_hull(c) : c, parts[k / 4 % 5], parts[k / 20 % 5]));
  }
  return result;
}

/// Metres: the promise of the headers, and what doubles place the bodies to.
double promised_for(const Configuration& c) {
  const double apart = (c.pose_a.position() - c.pose_b.position()).norm();
  return 1e-13 * (larger_size(c) + apart) + position_rounding(c);
}

class Rounded : public testing::TestWithParam<Pair> {};

TEST_P(Rounded, BodiesHaveTheTruesDistanceAndNormal) {
  for (const Configuration& c : rounded_bodies(GetParam())) {
    SCOPED_TRACE(testing::PrintToString(c.a.rounding()));
    const oracle::Truth t = oracle::truth(c);
    const double truth = t.signed_distance.midpoint();
    const SignedDistance found = signed_distance(c);
    EXPECT_NEAR(found.value, truth, promised_for(c));
    EXPECT_LE(oracle::normal_regret(c, t, found.normal), promised_for(c));
    const CertifiedDistance certified = certified_distance(c);
    EXPECT_NEAR(certified.value, truth, certified.error_bound);
    if (std::abs(truth) > promised_for(c)) {
      EXPECT_EQ(overlaps(c), truth < 0);
    }
    const Contact beyond = contact(c, truth - smaller_size(c));
    EXPECT_TRUE(beyond.points().empty());
    EXPECT_LE(beyond.signed_distance, truth + promised_for(c));
  }
}

TEST_P(Rounded, BodiesMeetAtTheirPoints) {
  for (const Configuration& c : rounded_bodies(GetParam())) {
    const double distance = signed_distance(c).value;
    const Contact answer = contact(c, std::max(distance, 0.0) + 1e-6 * smaller_size(c));
    ASSERT_FALSE(answer.points().empty());
    double deepest = answer.points()[0].depth;
    const double aside = 1e-6 * larger_size(c) + position_rounding(c) + seen_at_a_slant(c, answer);
    for (const ContactPoint& p : answer.points()) {
      deepest = std::max(deepest, p.depth);
      const Vec3 half = p.depth / 2 * answer.normal;
      EXPECT_NEAR(point_distance(c.a, c.pose_a, p.position - half), 0, aside);
      EXPECT_NEAR(point_distance(c.b, c.pose_b, p.position + half), 0, aside);
    }
    EXPECT_NEAR(deepest, -distance, 1e-6 * smaller_size(c) + promised_for(c));
  }
}

TEST_P(Rounded, BodiesAreAnsweredInBatchesAsOneByOne) {
  for (const Configuration& c : rounded_bodies(GetParam())) {
    const std::vector<Pose> of_a(3, c.pose_a), of_b(3, c.pose_b);
    std::vector<SignedDistance> distances(3);
    signed_distance(c.a, of_a, c.b, of_b, distances);
    for (const SignedDistance& found : distances) {
      EXPECT_EQ(found.value, signed_distance(c).value);
      EXPECT_EQ(found.normal, signed_distance(c).normal);
    }
  }
}

// The hint decides between normals whose gaps tie to within the threshold, and not to within the
// roundings.
TEST_P(Rounded, BodiesHaveAHintsNormalOnlyWhereItTies) {
  for (const Configuration& c : rounded_bodies(GetParam())) {
    const double threshold = 1e-3 * smaller_size(c);
    const SignedDistance found = signed_distance(c);
    if (found.value > threshold) continue;
    for (const Vec3& previous : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
      const Contact answer = contact(c, threshold, &previous);
      if (std::holds_alternative<Plane>(c.b)) continue;
      EXPECT_GE(gap(c, answer.normal), found.value - threshold - promised_for(c));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Rounded, testing::ValuesIn(all_pairs), name_of_other);

TEST(RoundedBodies, CylindersExchangedHaveTheOppositeContact) {
  for (const Configuration& c : rounded_bodies(Pair::cylinder)) {
    const double threshold = std::max(signed_distance(c).value, 0.0) + smaller_size(c);
    const Contact one = contact(c, threshold), other = contact(exchanged(c), threshold);
    EXPECT_EQ(one.signed_distance, other.signed_distance);
    EXPECT_EQ(one.normal, Vec3(-other.normal));
    ASSERT_EQ(one.points().size(), other.points().size());
    for (std::size_t i = 0; i < one.points().size(); ++i) {
      EXPECT_EQ(one.points()[i].position, other.points()[i].position);
      EXPECT_EQ(one.points()[i].depth, other.points()[i].depth);
    }
  }
}

TEST(RoundedBodies, BodiesOfTheSmallestAndLargestLengthsAreAnswered) {
  for (const double scale : {1e-300, 1e-30, 1e30, 1e150}) {
    for (const Configuration& given : rounded_bodies(Pair::box)) {
      if (larger_size(given) > 10 || smaller_size(given) < 0.01) continue;
      const Configuration c = scaled(given, scale);
      EXPECT_NEAR(signed_distance(c).value / scale, signed_distance(given).value,
                  1e-12 * (larger_size(given) + given.pose_a.position().norm() +
                           given.pose_b.position().norm()));
    }
  }
}

// A cap of the core rests on a floor, at the body's own height.
TEST(RoundedBodies, ACapStandsOnItsCoresRim) {
  const Contact answer = contact(
      Configuration{Cylinder(2, 3, 0.5), Pose(Vec3(0, 0, 2.9)), Plane({0, 0, 1}, 0), Pose()}, 0);
  EXPECT_NEAR(answer.signed_distance, -0.1, 1e-15);
  ASSERT_GE(answer.points().size(), 3u);
  for (const ContactPoint& p : answer.points()) {
    EXPECT_NEAR(p.position.head<2>().norm(), 1.5, 1e-12);
    EXPECT_NEAR(p.position.z(), -0.05, 1e-12);
    EXPECT_NEAR(p.depth, 0.1, 1e-12);
  }
  const Contact ball = contact(
      Configuration{Cylinder(2, 2, 2), Pose(Vec3(0, 0, 1.9)), Plane({0, 0, 1}, 0), Pose()}, 0);
  EXPECT_EQ(ball.points().size(), 1u) << "a sphere has one";
}

}  // namespace
}  // namespace touchstone
