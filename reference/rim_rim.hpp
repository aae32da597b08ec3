#pragma once

#include "largest_gap.hpp"
#include "rims.hpp"

namespace touchstone {

/// Offers `best` the normals at which the rims of two cylinders meet, wherever one of them may have
/// a larger gap; stops as soon as the gap exceeds `stop_above`.
///
/// The best normal so far tells which ends' rims are likely to meet. Newton's method from where
/// these cross, or along two points that face each other, mostly ends at a maximum that proves
/// itself the largest (deep_normals.hpp). Else, of each pair of ends, the arc of the smaller rim is
/// found where a maximum can lie at all (Rims::useful_cosines); mostly there is none. That arc is
/// searched to the end (RimScan).
void offer_rim_rim_normals(const FoldedCylinders& pair, double stop_above, LargestGap& best);

/// Searches the rims of all four pairs of ends, whatever is known of them. Returns by how much the
/// largest gap where rims meet may exceed the best one, but for rounding: zero where the search is
/// proven complete.
double search_all_rims(const FoldedCylinders& pair, LargestGap& best);

}  // namespace touchstone
