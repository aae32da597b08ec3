// Limits of right answers to casts, where they are known on paper; that scores change there, the
// test of the suite's casts holds.
#include "reports/test_data/cast_limits.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

using Touch = AnswerLimits::Contact;

constexpr double allowed = 1e-3;
/// To which part of the tolerance a limit is found, and rounded.
constexpr double accuracy = 1.0 / 1024;

/// A standing can of height and diameter 1, with B at the origin.
CastLimits limits_of(const Shape& b, const Vec3& start, const Vec3& sweep) {
  const Configuration c{Cylinder(0.5, 0.5), Pose(start), b, Pose()};
  return cast_limits(c, sweep, oracle::first_touch(c, Sweep(sweep)), allowed);
}
const Plane ground({0, 0, 1}, 0);

void expect_limits(const CastLimits& limits, Touch touch, double min_fraction, double max_fraction,
                   double length) {
  EXPECT_EQ(limits.touch, touch);
  const double rounding = 2 * accuracy * allowed / length;
  EXPECT_LE(limits.min_fraction, min_fraction + rounding);
  EXPECT_GE(limits.min_fraction, min_fraction - rounding);
  EXPECT_LE(limits.max_fraction, max_fraction + rounding);
  EXPECT_GE(limits.max_fraction, max_fraction - rounding);
}

TEST(CastLimits, HeadOnAreTheToleranceToBothSides) {
  expect_limits(limits_of(ground, {0, 0, 1}, {0, 0, -2}), Touch::required, 0.25 - allowed / 2,
                0.25 + allowed / 2, 2);
}

TEST(CastLimits, OfASweepThatEndsWithinTheToleranceLeaveItOpen) {
  for (const double end : {-0.9, 0.0, 0.9}) {
    expect_limits(limits_of(ground, {0, 0, 1}, {0, 0, -0.5 + end * allowed}), Touch::optional,
                  (0.5 - allowed) / (0.5 - end * allowed), 1, 0.5);
  }
  const CastLimits short_of_it = limits_of(ground, {0, 0, 1}, {0, 0, -0.5 + 1.1 * allowed});
  EXPECT_EQ(short_of_it.touch, Touch::forbidden);
  EXPECT_GT(short_of_it.min_fraction, short_of_it.max_fraction);
}

TEST(CastLimits, WhereBodiesGrazeAreTheRootOfTheTolerance) {
  // The side of the can passes a ball: their centres' distance is 1.5, and at both ends more by the
  // tolerance.
  const auto reach = [](double tolerance) {
    return std::sqrt(std::pow(1.5 + tolerance, 2) - 1.5 * 1.5);
  };
  const CastLimits found = limits_of(Sphere(1), {-2, 1.5, 0}, {4, 0, 0});
  const double exact = reach(allowed), rounded = reach((1 + 2 * accuracy) * allowed);
  EXPECT_EQ(found.touch, Touch::optional);
  EXPECT_LE(found.min_fraction, (2 - exact) / 4);
  EXPECT_GE(found.min_fraction, (2 - rounded) / 4);
  EXPECT_GE(found.max_fraction, (2 + exact) / 4);
  EXPECT_LE(found.max_fraction, (2 + rounded) / 4);
}

TEST(CastLimits, FromADeepStartAreWhatMovesAByTheTolerance) {
  expect_limits(limits_of(ground, {0, 0, 0.25}, {0, 0, 4}), Touch::required, 0, allowed / 4, 4);
}

TEST(CastLimits, WithoutAWayAreAllFractionsOrNone) {
  expect_limits(limits_of(ground, {0, 0, 0.5}, Vec3::Zero()), Touch::optional, 0, 1, 1);
  EXPECT_EQ(limits_of(ground, {0, 0, 1}, Vec3::Zero()).touch, Touch::forbidden);
}

}  // namespace
}  // namespace touchstone
