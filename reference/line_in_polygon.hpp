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

/// Keeps of `range` what of the line is in the polygon, or the place where they only touch. An edge
/// along which it runs, but for a hair, bounds nothing, whichever side of that rounding puts it on;
/// of a sliver that is all but the corners.
inline void keep_within_polygon(Interval& range, const Line& l, const CarriedCorners& corners,
                                double hair) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Interval kept = range, reached{infinite, -infinite};
  const double inverse = 1 / l.along.squaredNorm();
  Vec2 p = corners.corner(corners.count() - 1);
  for (int i = 0; i < corners.count(); ++i) {
    const Vec2 q = corners.corner(i), edge = q - p;
    const double length = edge.norm();
    if (length > 0) {
      const Vec2 outward(edge.y() / length, -edge.x() / length);
      const double offset = outward.dot(l.middle - p), rises = outward.dot(l.along);
      if (std::abs(rises) * (range.hi - range.lo) > hair) {
        const double end = -offset / rises;
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
}

}  // namespace touchstone
