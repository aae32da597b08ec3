#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_plane.hpp"
#include "curves.hpp"

namespace touchstone {

/// Of a line's parameter.
struct Interval {
  double lo, hi;
  bool empty() const { return !(lo <= hi); }
};

/// How far beyond an edge a line of a round body is let go that rises over it by `slant` as a
/// whole: what grazes the edge is so the longer the less it does, for where they cross is no more
/// than a step nobody sees says, or than which of two normals rounding prefers that are as good but
/// for 1e-7. Moved onto the edge it lies lower by the square of that, 5e-9 of the radius.
inline double let_beyond(double radius, double slant) {
  constexpr double grazing_part = 1e-4;
  return std::max(grazing_part * radius - slant, 0.0);
}

/// Keeps of `range` what of the line is in the polygon, or the place where they only touch. An edge
/// along which it runs, but for a hair, bounds nothing, whichever side of that rounding puts it on;
/// of a sliver that is all but the corners. Returns whether it grazes an edge, beyond which it then
/// may go (`let_beyond`).
inline bool keep_within_polygon(Interval& range, const Line& l, const CarriedCorners& corners,
                                double hair) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Interval kept = range, reached{infinite, -infinite};
  const double inverse = 1 / l.along.squaredNorm();
  bool grazes = false;
  Vec2 p = corners.corner(corners.count() - 1);
  for (int i = 0; i < corners.count(); ++i) {
    const Vec2 q = corners.corner(i), edge = q - p;
    const double length = edge.norm();
    if (length > 0) {
      const Vec2 outward(edge.y() / length, -edge.x() / length);
      const double offset = outward.dot(l.middle - p), rises = outward.dot(l.along);
      if (const double slant = std::abs(rises) * (range.hi - range.lo); slant > hair) {
        const double beyond = let_beyond(l.radius, slant), end = (beyond - offset) / rises;
        grazes = grazes || beyond > 0;
        rises > 0 ? kept.hi = std::min(kept.hi, end) : kept.lo = std::max(kept.lo, end);
      }
    }
    const double foot = inverse * l.along.dot(q - l.middle);
    reached = {std::min(reached.lo, foot), std::max(reached.hi, foot)};
    p = q;
  }
  kept = {std::max(kept.lo, reached.lo), std::min(kept.hi, reached.hi)};
  if (kept.empty()) {
    const double middle = within((kept.lo + kept.hi) / 2, range.lo, range.hi);
    kept = {middle, middle};
  }
  range = kept;
  return grazes;
}

/// Moves a place of a line that grazes an edge of the polygon onto the edge.
inline Vec2 moved_onto(const CarriedCorners& corners, double radius, Vec2 place) {
  Vec2 p = corners.corner(corners.count() - 1);
  for (int i = 0; i < corners.count(); ++i) {
    const Vec2 q = corners.corner(i), edge = q - p;
    if (const double length = edge.norm(); length > 0) {
      const Vec2 outward(edge.y() / length, -edge.x() / length);
      const double off = outward.dot(place - p);
      if (off > 0 && off <= let_beyond(radius, 0)) place -= off * outward;
    }
    p = q;
  }
  return place;
}

}  // namespace touchstone
