#pragma once

#include "largest_gap.hpp"
#include "rims.hpp"

namespace touchstone {

/// Offers `best` the normals at which the rims of two cylinders meet, wherever one of them may have
/// a larger gap; stops as soon as the gap exceeds `enough`.
///
/// Of each pair of ends, the arc of the smaller rim is found where a local maximum can lie at all
/// (Rims::useful_cosines); mostly there is none. Newton's method from its middle, along two points
/// that face each other, or from where the rims of nearly parallel caps cross, ends at a maximum
/// that mostly proves itself the largest (deep_normals.hpp). Else half of the smaller rim (the
/// other half is its mirror image) is scanned on that arc with the nearest points of the larger rim
/// (RimScan): parts that are too far away to matter are left out, sign changes of the slope are
/// bracketed, and arcs are as short as the slope is uneven. At most 400 samples for each pair of
/// ends.
void offer_rim_rim_normals(const FoldedCylinders& pair, double enough, LargestGap& best);

}  // namespace touchstone
