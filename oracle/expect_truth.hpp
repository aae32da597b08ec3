#pragma once

#include <gtest/gtest.h>

#include "oracle/brute_force.hpp"
#include "oracle/truth.hpp"
#include "reference/support.hpp"

namespace touchstone::oracle {

/// Checks an enclosure against a method that shares nothing with it: no direction in double may
/// show a larger gap than σ, and the reported normals must reach σ.
inline void expect_brute_force_agrees(const Configuration& c, const Truth& t,
                                      int directions = 1000) {
  // Rounding of g in double: a few ulp of the lengths that enter it.
  const double lengths = larger_size(c) + (c.pose_a.position() - c.pose_b.position()).norm();
  const double rounding = 1e-14 * lengths;
  const double sigma = t.signed_distance.midpoint();
  EXPECT_LE(t.signed_distance.width(), 1e-15 * larger_size(c));
  ASSERT_FALSE(t.normals.empty());
  for (const OptimalNormal& normal : t.normals) {
    EXPECT_NEAR(touchstone::gap(c, normal.n), sigma, rounding) << "normal " << normal.n.transpose();
  }
  const BruteForce found = brute_force_maximum(c, directions);
  EXPECT_LE(found.gap, sigma + rounding) << "along " << found.normal.transpose();
}

}  // namespace touchstone::oracle
