#pragma once

#include "reduced_pair.hpp"

namespace touchstone {

/// Offers `best` the normals at which a point of rim 1 (about the origin) and a point of rim 2
/// (about q, q = d less the segments' chosen ends) are stationary for each other. Scans rim 1 with
/// the closed-form nearest and farthest points of rim 2 and brackets the sign changes of the slope.
void offer_rim_rim_normals(const ReducedPair& pair, const Vec3& q, BestNormal& best);

}  // namespace touchstone
