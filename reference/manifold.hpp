#pragma once

#include <algorithm>
#include <limits>

#include "contact.hpp"
#include "facing_feature.hpp"

namespace touchstone {

/// How far above the deepest point a surface may lie and still carry a point, metres: a thousandth
/// of the smaller body's largest half extent, so that a standing or lying body keeps its points
/// when a step of a simulation tilts it, as long as they overlap: no more than the contact
/// threshold leaves above the deepest point; never less than rounding. `offset` is how far the
/// bodies' centres are apart, or somewhat more.
inline double manifold_slack(double largest_a, double largest_b, double offset,
                             double signed_distance, double contact_threshold) {
  constexpr double hair = 1e-3, rounding = 16 * std::numeric_limits<double>::epsilon();
  return std::max(
      rounding * (std::max(largest_a, largest_b) + offset),
      std::min(hair * std::min(largest_a, largest_b), contact_threshold - signed_distance));
}

/// Adds to `contact`, whose normal and signed distance are set, the points where two features face
/// each other, and to each of them `origin`, where the features' frame lies in the world.
///
/// The features' overlap across the normal is a point (one contact point), a segment (its two ends)
/// or a region bounded by lines and arcs (its corners and points on long arcs, at most eight; three
/// where it is a whole disc). Of features that lean, the part within the slack of the deepest point
/// counts, so that the points draw together as the tilt grows. Each lies halfway between the
/// surfaces along the normal.
void add_manifold(Contact& contact, const FacingFeature& a, const FacingFeature& b,
                  const Vec3& origin, double slack);

}  // namespace touchstone
