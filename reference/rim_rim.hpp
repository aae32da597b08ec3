#pragma once

#include "largest_gap.hpp"
#include "rims.hpp"

namespace touchstone {

/// Offers `best` the normals at which the rims of two cylinders meet, wherever one of them may have
/// a larger gap; stops as soon as the gap exceeds `enough`. `apart` goes from a point of B to one
/// of A, not far from each other if possible.
///
/// Newton's method along `apart` finds the normal of rims that face each other; where bodies are
/// apart that is all. Else, for each pair of ends that can meet, half of the smaller rim (the other
/// half is its mirror image) is scanned with the nearest points of the larger rim. Arcs that are
/// too far away to matter are left out, sign changes of the slope are bracketed, and arcs are as
/// short as the slope is uneven. At most 400 samples for each pair of ends.
void offer_rim_rim_normals(const FoldedCylinders& pair, const Vec3& apart, double enough,
                           LargestGap& best);

}  // namespace touchstone
