#pragma once

#include "reduced_pair.hpp"

namespace touchstone {

/// Offers `best` the normals at which a point of rim 1 (about the origin) and a point of rim 2
/// (about q, q = d less the segments' chosen ends) are stationary for each other, and lowers its
/// limit by the points met. Scans the smaller rim with the closed-form nearest and farthest points
/// of the larger one and brackets the sign changes of the slope; the arcs are as short as the slope
/// is uneven, and those too far away to matter are left out.
void offer_rim_rim_normals(const ReducedPair& pair, const Vec3& q, BestNormal& best);

}  // namespace touchstone
