#pragma once

#include "candidates/candidate.h"
#include "oracle/patch/contact_patch.hpp"

namespace touchstone {

/// How far a plane convex set has moved in space, metres: the Hausdorff distance, the farthest that
/// a point of either set is from the other. Exact for polygons; of arcs 32 points a circle are
/// taken.
double movement(const oracle::ContactPatch& from, const oracle::ContactPatch& to);

/// The hull of an answer's contact points, seen along its normal, in the plane through their mean.
/// Preconditions: at least one point, all numbers finite, the normal not zero.
oracle::ContactPatch hull_of_points(const ts_answer& answer);

}  // namespace touchstone
