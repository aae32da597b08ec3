#pragma once

#include <array>

#include "curves.hpp"

namespace touchstone {

// Where a flat patch carries a body. A layout is a few points whose hull stands for the patch. It
// must not turn with what rounding makes of a tilt, for a body at rest would be held elsewhere in
// every step (warm starting would be in vain), and yet it must hold the deepest point of a body
// that clearly leans. Three points cannot follow the deepest place all around a rim and be at rest
// when there is none. So the deepest point is one more, which grows out of the layout's middle as
// the tilt becomes clear; the hull moves, and never jumps.

/// How much of the deepest point's way from the layout's middle to its place a disc takes whose
/// clearance rises by `rise` metres across it: 0 while that is no more than `clear_rise`
/// (manifold.hpp), 1 from twice that on.
double deepest_point_weight(double rise, double clear_rise);

/// One layout handed over to another about the same middle. First the new one grows from half its
/// size, where it lies within the hull of the old; then the old one shrinks to half its size.
struct HandOver {
  double progress;  ///< 0 or less: all old; 2 or more: all new
  bool has_begun() const { return progress > 0; }
  bool is_over() const { return progress >= 2; }
  double new_size() const { return progress < 1 ? (1 + progress) / 2 : 1; }
  double old_size() const { return progress > 1 ? (3 - progress) / 2 : 1; }
};

/// Three arms of this length, 120° apart, the first along a unit vector.
std::array<Vec2, 3> three_arms(double radius, const Vec2& unit);

/// Points of a whole disc, as arms from its centre, over which the clearance has this slope: three
/// of its rim, the first along the unit vector `anchor`, while it is level; then the deepest one
/// too; and where nearly as much of it as the slack rises above the deepest, only that one and one
/// to either side, 120° off or where the rim rises above the slack. `clear_rise` is at most an
/// eighth of the slack. Returns how many.
int spread_disc(double radius, const Vec2& slope, const Vec2& anchor, double slack,
                double clear_rise, std::array<Vec2, 6>& arms);

}  // namespace touchstone
