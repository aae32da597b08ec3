#pragma once

#include <gtest/gtest.h>

#include "oracle/audit/enclose.hpp"
#include "oracle/truth.hpp"
#include "reference/support.hpp"

namespace touchstone {

/// Expects (as a test) that the second oracle encloses the same signed distance, and that the
/// reported normals reach it (but for a half-space, whose gap doubles do not have). The best
/// direction that the second oracle finds has to come within `found_within` of it, relative to the
/// larger size: so closely it would show that the first one has missed a direction. Returns the
/// second one's enclosure.
inline audit::Enclosure expect_confirmed(const Configuration& c, const oracle::Truth& t,
                                         const audit::Budget& budget = {1e-12, 4000},
                                         double found_within = 1e-9) {
  // Of the reference's gap in double: a few ulp of the lengths that enter it.
  const double lengths = larger_size(c) + (c.pose_a.position() - c.pose_b.position()).norm();
  const double rounding = 1e-14 * lengths, sigma = t.signed_distance.midpoint();
  EXPECT_LE(t.signed_distance.width(), 1e-15 * larger_size(c));
  EXPECT_FALSE(t.normals.empty());
  const bool is_plane = std::holds_alternative<Plane>(c.b);
  for (const oracle::OptimalNormal& normal : t.normals) {
    if (is_plane) break;
    EXPECT_NEAR(gap(c, normal.n), sigma, rounding) << "normal " << normal.n.transpose();
  }
  audit::Enclosure e = audit::enclose(c, budget);
  EXPECT_LE(mpq_class(e.lo), t.signed_distance.hi) << "along " << e.normal.transpose();
  EXPECT_GE(mpq_class(e.hi), t.signed_distance.lo);
  EXPECT_GE(mpq_class(e.pair_distance), t.signed_distance.lo);
  EXPECT_GE(e.lo, sigma - found_within * larger_size(c) - rounding);
  return e;
}

}  // namespace touchstone
