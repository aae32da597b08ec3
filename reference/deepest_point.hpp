#pragma once

#include "contact.hpp"
#include "reduced_pair.hpp"

namespace touchstone {

/// The answer for a known normal: its one contact point halfway between two facing points of the
/// surfaces, if they are no further apart than the threshold. Where the bodies face each other in
/// more than a point (parallel sides, a cap on a face), one near the middle of B's feature.
/// `centre_b` is B's position in the world.
Contact with_deepest_point(const ReducedPair& pair, const Vec3& centre_b, const BestNormal& best,
                           double contact_threshold);

}  // namespace touchstone
