#pragma once

#include "candidates/candidate.h"
#include "oracle/patch/contact_patch.hpp"

namespace touchstone {

/// The hull of an answer's contact points, seen along its normal, in the plane through their mean.
/// Preconditions: at least one point, all numbers finite, the normal not zero.
oracle::ContactPatch hull_of_points(const ts_answer& answer);

/// The Hausdorff distance of two plane convex sets in space, metres: the largest distance of a
/// point of either set from the other. Exact for polygons; of arcs 32 points a circle are taken.
double movement(const oracle::ContactPatch& from, const oracle::ContactPatch& to);

}  // namespace touchstone
