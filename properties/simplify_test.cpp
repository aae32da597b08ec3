#include "properties/simplify.hpp"

#include <gtest/gtest.h>

#include "properties/identity.hpp"

namespace touchstone {
namespace {

TEST(Simplify, EveryStepIsSimplerAndOfTheSamePair) {
  for (const Pair pair : all_pairs) {
    const Configuration c = make_configuration({pair, "general-shallow", 1, 0});
    const auto steps = simpler(c);
    EXPECT_GT(steps.size(), 20u);
    for (const Configuration& next : steps) {
      EXPECT_LT(complexity(next), complexity(c));
      EXPECT_EQ(pair_of(next), pair);
    }
  }
}

TEST(Simplify, WhatAlwaysFailsEndsAtUnitBodiesAtTheOrigin) {
  for (const Pair pair : all_pairs) {
    const Configuration c = simplified(make_configuration({pair, "general-deep", 2, 3}),
                                       [](const Configuration&) { return true; });
    EXPECT_EQ(c.a.radius(), 1);
    EXPECT_EQ(c.a.half_length(), 1);
    EXPECT_TRUE(c.pose_a.position().isZero(0));
    EXPECT_TRUE(c.pose_b.position().isZero(0));
    EXPECT_TRUE(c.pose_a.orientation().coeffs() == Eigen::Vector4d(0, 0, 0, 1));
    EXPECT_TRUE(c.pose_b.orientation().coeffs() == Eigen::Vector4d(0, 0, 0, 1));
  }
}

TEST(Simplify, KeepsWhatTheFailureNeeds) {
  // Fails as long as the bodies' axes are not parallel and A is a coin.
  const auto fails = [](const Configuration& c) {
    const Vec3 a = c.pose_a.rotation().col(2), b = c.pose_b.rotation().col(2);
    return a.cross(b).norm() > 1e-3 && c.a.radius() > 3 * c.a.half_length();
  };
  Configuration start = make_configuration({Pair::cylinder, "general-deep", 2, 3});
  start.a = Cylinder(0.337, 0.011);
  ASSERT_TRUE(fails(start));
  const Configuration c = simplified(start, fails);
  EXPECT_TRUE(fails(c));
  EXPECT_LE(complexity(c), 25);
}

TEST(Simplify, StopsWhenItsTrialsAreSpent) {
  const Configuration start = make_configuration({Pair::box, "general-deep", 2, 3});
  int calls = 0;
  const Configuration c = simplified(
      start,
      [&](const Configuration&) {
        ++calls;
        return false;
      },
      7);
  EXPECT_EQ(calls, 7);
  EXPECT_EQ(complexity(c), complexity(start));
}

}  // namespace
}  // namespace touchstone
