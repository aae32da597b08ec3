#pragma once

#include "folded_axes.hpp"
#include "largest_gap.hpp"

namespace touchstone {

/// Two cylinders in their folded frame; the first has the smaller radius or the same.
struct FoldedCylinders {
  FoldedAxes axes;
  double r1, h1, r2, h2;

  /// g(n) of any n, divided by its length.
  double gap(const Vec3& n) const;
};

/// Offers `best` the normals at which the rims of two cylinders meet, wherever one of them may have
/// a larger gap. For each pair of ends that can meet at all it scans half of the smaller rim (the
/// other half is its mirror image) with the nearest points of the larger rim, leaves out the arcs
/// that are too far away to matter, and brackets the sign changes of the slope; arcs are as short
/// as the slope is uneven. At most 400 samples for each pair of ends and side.
void offer_rim_rim_normals(const FoldedCylinders& pair, LargestGap& best);

}  // namespace touchstone
