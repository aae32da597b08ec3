#pragma once

#include <cmath>

#include "curves.hpp"
#include "folded_axes.hpp"
#include "largest_gap.hpp"

// The largest gap of a cylinder and a segment, which is what a capsule is less its radius, and a
// hull's edge alone. It lies at one normal of four kinds. In the frame of both axes each has a
// closed form, but for the segment over a rim, which is a point against an ellipse:
//
//   cap_and_end      along the cylinder's axis: an end above a cap
//   side             across that axis: the segment crosses a side, or it or its end lies beside it
//   rim_and_segment  across the segment: it crosses a rim
//   rim_and_end      neither, only apart: an end off a rim
//
// The first two prove themselves where the segment meets a smooth place of the cylinder its depth
// away from the rims: a ball of that radius fits behind it, so that no way out is shorter.

namespace touchstone {

/// A cylinder and a segment in the frame of their axes.
struct FoldedSegment {
  FoldedAxes axes;
  double r1, h1;  ///< radius and half length of the cylinder
  double h2;      ///< half length of the segment
};

/// Does a point of the side, so far along the axis, lie its depth away from the ends?
inline bool is_within_side(const FoldedSegment& p, double along, double gap) {
  const double delta = depth(gap);
  const bool is_between = std::abs(along) <= p.h1 - delta, is_thick = delta <= p.r1;
  return is_between & is_thick;  // branch-free: either is as likely
}

// Each stage has nothing to say where it is clear that its gap is not above `best`.

inline StageResult cap_and_end(const FoldedSegment& p) {
  const FoldedAxes& f = p.axes;
  const double side = std::copysign(1, f.d1), gap = std::abs(f.d1) - p.h1 - p.h2 * f.c;
  const double y = f.d2 - side * p.h2 * f.s, reach = p.r1 - depth(gap);
  return {gap, side, 0, 0,
          depth(gap) <= p.h1 && reach >= 0 && y * y + f.d3 * f.d3 <= reach * reach};
}

/// Of the segment the point nearest to A's axis as seen along that: where they cross, or an end.
/// Parallel to the axis, all are, and the one nearest to A's centre counts.
inline StageResult side(const FoldedSegment& p, double best) {
  const FoldedAxes& f = p.axes;
  constexpr double flat = 1e-15;
  const double beside = std::max(std::abs(f.d2) - p.h2 * f.s, 0.0);
  const double length = std::sqrt(beside * beside + f.d3 * f.d3), gap = length - p.r1;
  if (gap <= best) return {};
  const double at = f.s > flat ? f.d2 / f.s : f.d1;
  const double along = std::max(-p.h2, std::min(p.h2, at));
  const bool is_proven = is_within_side(p, f.d1 - f.c * along, gap);
  if (!(beside > 0)) return {gap, 0, 0, 1, is_proven};
  return {gap, 0, std::copysign(beside, f.d2) / length, f.d3 / length, is_proven};
}

/// Seen along the segment the cap is an ellipse about the end of A's axis. `missed`, where it is
/// asked for, is by how much a normal across the segment may be better than the best one so far.
inline StageResult rim_and_segment(const FoldedSegment& p, double best, double* missed) {
  const FoldedAxes& f = p.axes;
  const double along_k2 = f.along_k2(f.d());
  const double y = std::abs(along_k2) - p.h1 * f.s, b = p.r1 * f.c;
  // No direction is better than the distance from the ellipse's inscribed disc.
  if (f.d3 * f.d3 + y * y <= (best + b) * (best + b) && best + b > 0) return {};
  // A point inside may be too far behind the chord of the ellipse's quadrant.
  if (p.r1 * b - b * f.d3 - p.r1 * y >= depth(best) * (p.r1 + b)) return {};
  const auto n = ellipse_normal(p.r1, b, f.d3, y);
  StageResult found;
  if (n) {
    const double side = std::copysign(n->y(), along_k2);
    const double gap = n->x() * f.d3 + n->y() * y -
                       std::sqrt(p.r1 * p.r1 * n->x() * n->x() + b * b * n->y() * n->y());
    found = {gap, -f.s * side, f.c * side, n->x()};
  }
  if (missed) *missed = ellipse_excess(p.r1, b, f.d3, y, n, -std::max(best, found.gap));
  return found;
}

/// The end that is nearest to the cylinder, beyond both a cap and the side.
inline StageResult rim_and_end(const FoldedSegment& p, double best) {
  const FoldedAxes& f = p.axes;
  StageResult found;
  for (const double end : {-p.h2, p.h2}) {
    const double q1 = f.d1 - end * f.c, q2 = f.d2 - end * f.s, q3 = f.d3;
    const double above = std::abs(q1) - p.h1;
    const double radial = std::sqrt(q2 * q2 + q3 * q3), beside = radial - p.r1;
    // Else the other end is farther along n, as it always is where both bodies meet.
    const double back = f.c * std::copysign(above, q1) * radial + f.s * beside * q2;
    if (!((above > 0) & (beside > 0) & (end * back >= 0))) continue;
    const double distance = std::sqrt(above * above + beside * beside);
    if (distance <= best) continue;
    const double x = std::copysign(above, q1) / distance, across = beside / (radial * distance);
    const double y = across * q2, z = across * q3;
    // The gap itself: the other end may be further along n.
    const double gap = x * f.d1 + y * f.d2 + z * f.d3 - p.h2 * std::abs(f.c * x + f.s * y) -
                       p.h1 * std::abs(x) - p.r1 * std::sqrt(y * y + z * z);
    found.improve({gap, x, y, z});
  }
  return found;
}

inline StageResult largest_gap(const FoldedSegment& p, EarlyExit exit, double* missed) {
  StageResult best = cap_and_end(p);
  if (exit.ends_with(best)) return best;
  best.improve(side(p, best.gap));
  if (exit.ends_with(best)) return best;
  best.improve(rim_and_segment(p, best.gap, best.is_proven ? nullptr : missed));
  best.improve(rim_and_end(p, best.gap));
  return best;
}

}  // namespace touchstone
