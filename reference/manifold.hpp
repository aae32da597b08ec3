#pragma once

#include "contact.hpp"
#include "facing_feature.hpp"
#include "margins.hpp"

namespace touchstone {

/// Adds to `contact`, whose normal and signed distance are set, the points where two features face
/// each other, and to each of them `origin`, where the features' frame lies in the world.
///
/// The features' overlap across the normal is a point (one contact point), a segment (its two ends)
/// or a region bounded by lines and arcs (its corners and points on long arcs, at most eight; three
/// where it is a whole disc). Of features that lean, the part within the slack of the deepest point
/// counts, so that the points draw together as the tilt grows. Each lies halfway between the
/// surfaces along the normal.
void add_manifold(Contact& contact, const FacingFeature& a, const FacingFeature& b,
                  const Vec3& origin, const Margins& margins);

}  // namespace touchstone
