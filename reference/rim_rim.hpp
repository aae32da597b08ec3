#pragma once

#include "largest_gap.hpp"
#include "rims.hpp"

namespace touchstone {

/// Offers `best` the normals at which the rims of two cylinders meet, wherever one of them may have
/// a larger gap; stops as soon as the gap exceeds `enough`.
///
/// The best normal so far tells which ends' rims are likely to meet. Newton's method from where
/// these cross, or along two points that face each other, mostly ends at a maximum that proves
/// itself the largest (deep_normals.hpp). Else, of each pair of ends, the arc of the smaller rim is
/// found where a local maximum can lie at all (Rims::useful_cosines); mostly there is none. Half of
/// the rim (the other half is its mirror image) is scanned on that arc with the nearest points of
/// the larger rim (RimScan): parts that are too far away to matter are left out, sign changes of
/// the slope are bracketed, and arcs are as short as the slope is uneven. At most 400 samples for
/// each pair of ends.
void offer_rim_rim_normals(const FoldedCylinders& pair, double enough, LargestGap& best);

}  // namespace touchstone
