#include <algorithm>
#include <cmath>
#include <optional>

#include "curves.hpp"
#include "folded_axes.hpp"
#include "pair.hpp"

// The capsule less its radius is a segment, so that the largest gap lies at one normal of five
// kinds. In the frame of both axes each has a closed form, but for the segment over a rim, which is
// a point against an ellipse:
//
//   cap_and_end       along the cylinder's axis: an end above a cap
//   side_and_segment  across both axes: the segment crosses a side, or lies beside it
//   side_and_end      across the cylinder's axis: an end beside a side
//   rim_and_segment   across the segment: it crosses a rim
//   rim_and_end       neither, only apart: an end off a rim
//
// The first three prove themselves where the segment meets a smooth place of the cylinder its depth
// away from the rims: a ball of that radius fits behind it, so that no way out is shorter.

namespace touchstone {
namespace {

/// A cylinder and a segment in the frame of their axes.
struct Folded {
  FoldedAxes axes;
  double r1, h1;  ///< radius and half length of the cylinder
  double h2;      ///< half length of the segment
};

/// Does a point of the side, so far along the axis, lie its depth away from the ends?
bool is_within_side(const Folded& p, double along, double gap) {
  return std::abs(along) <= p.h1 - depth(gap) && depth(gap) <= p.r1;
}

// Each stage has nothing to say where it is clear that its gap is not above `best`.

StageResult cap_and_end(const Folded& p) {
  const FoldedAxes& f = p.axes;
  const double side = std::copysign(1, f.d1), gap = std::abs(f.d1) - p.h1 - p.h2 * f.c;
  const double y = f.d2 - side * p.h2 * f.s, reach = p.r1 - depth(gap);
  return {gap, side, 0, 0,
          depth(gap) <= p.h1 && reach >= 0 && y * y + f.d3 * f.d3 <= reach * reach};
}

StageResult side_and_segment(const Folded& p, double best) {
  const FoldedAxes& f = p.axes;
  const double gap = f.d3 - p.r1;
  if (gap <= best) return {};
  constexpr double flat = 1e-15;
  if (f.s <= flat) {  // side by side, e3 through both axes
    return {gap, 0, 0, 1,
            std::abs(f.d2) <= flat * f.d3 &&
                is_within_side(p, std::max(0.0, std::abs(f.d1) - p.h2), gap)};
  }
  const double along = f.d2 / f.s;
  return {gap, 0, 0, 1, std::abs(along) <= p.h2 && is_within_side(p, f.d1 - f.c * along, gap)};
}

/// Of the segment the end towards A lies at (0, h2 s) across A's axis.
StageResult side_and_end(const Folded& p, double best) {
  const FoldedAxes& f = p.axes;
  const double y = std::abs(f.d2) - p.h2 * f.s;
  if (!(y > 0)) return {};
  const double length = std::sqrt(y * y + f.d3 * f.d3), gap = length - p.r1;
  if (gap <= best) return {};
  return {gap, 0, std::copysign(y, f.d2) / length, f.d3 / length,
          is_within_side(p, f.d1 - std::copysign(p.h2, f.d2) * f.c, gap)};
}

/// Seen along the segment the cap is an ellipse about the end of A's axis. `missed`, where it is
/// asked for, is by how much a normal across the segment may be better than the best one so far.
StageResult rim_and_segment(const Folded& p, double best, double* missed) {
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
StageResult rim_and_end(const Folded& p, double best) {
  const FoldedAxes& f = p.axes;
  StageResult found;
  for (const double end : {-p.h2, p.h2}) {
    const double q1 = f.d1 - end * f.c, q2 = f.d2 - end * f.s, q3 = f.d3;
    const double above = std::abs(q1) - p.h1;
    const double radial = std::sqrt(q2 * q2 + q3 * q3), beside = radial - p.r1;
    if (!(above > 0 && beside > 0)) continue;
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

StageResult largest_gap(const Folded& p, EarlyExit exit, double* missed) {
  StageResult best = cap_and_end(p);
  if (exit.ends_with(best)) return best;
  best.improve(side_and_segment(p, best.gap));
  if (exit.ends_with(best)) return best;
  best.improve(side_and_end(p, best.gap));
  if (exit.ends_with(best)) return best;
  best.improve(rim_and_segment(p, best.gap, best.is_proven ? nullptr : missed));
  best.improve(rim_and_end(p, best.gap));
  return best;
}

/// A normal with a clearance of clearly more than `stop_above`, of those along one axis and across
/// both: what most bodies that are apart need, before they are folded. `d` is A's centre less B's.
std::optional<SignedDistance> separation(const PosedCylinder& a, const PosedCapsule& b,
                                         const Vec3& d, double stop_above) {
  const auto u = a.axis(), v = b.axis();
  // Component by component: Eigen would load in pairs what was just stored singly, which stalls.
  const double x = u.y() * v.z() - u.z() * v.y(), y = u.z() * v.x() - u.x() * v.z();
  const double z = u.x() * v.y() - u.y() * v.x();
  const double c = std::abs(u.dot(v)), s = std::sqrt(x * x + y * y + z * z);
  const double along1 = d.dot(u), along2 = d.dot(v), radii = a.radius + b.radius;
  const double more =
      stop_above + clear_part * (d.cwiseAbs().sum() + a.half_length + b.half_length + radii);
  const double gap1 = std::abs(along1) - a.half_length - b.half_length * c - b.radius;
  const double gap2 =
      std::abs(along2) - a.half_length * c - a.radius * s - b.half_length - b.radius;
  if (std::max(gap1, gap2) > more) {
    if (gap1 > gap2) return SignedDistance{gap1, std::copysign(1, along1) * u};
    return SignedDistance{gap2, std::copysign(1, along2) * v};
  }
  // The product of nearly parallel axes has few digits left.
  constexpr double few_digits = 0.1;
  const double across = d.x() * x + d.y() * y + d.z() * z;
  if (s > few_digits && std::abs(across) > (radii + more) * s) {
    const double scale = std::copysign(1, across) / s;
    return SignedDistance{std::abs(across) / s - radii, Vec3(scale * x, scale * y, scale * z)};
  }
  return std::nullopt;
}

CertifiedDistance find_largest(const PosedCylinder& a, const PosedCapsule& b, EarlyExit exit) {
  const Vec3 d = a.centre - b.centre;
  if (exit.stop_above < no_early_exit) {
    if (const auto apart = separation(a, b, d, exit.stop_above)) return {*apart, 0};
  }
  const Folded p{FoldedAxes(a.axis(), b.axis(), d), a.radius, a.half_length, b.half_length};
  const EarlyExit of_segment{exit.stop_above + b.radius, exit.trusts_proofs};
  double missed = 0;
  const StageResult best = largest_gap(p, of_segment, exit.trusts_proofs ? nullptr : &missed);
  return {{best.gap - b.radius, p.axes.to_world(best.normal())}, missed};
}

using CapsuleRoutine = SearchRoutine<PosedCapsule, find_largest>;

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Capsule& b,
                               const Pose& pose_b) {
  return find_signed_distance<CapsuleRoutine>(a, pose_a, b, pose_b);
}
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Capsule& b,
                                     const Pose& pose_b) {
  return find_certified_distance<CapsuleRoutine>(a, pose_a, b, pose_b);
}
bool overlaps(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b) {
  return find_overlap<CapsuleRoutine>(a, pose_a, b, pose_b);
}
Contact contact(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal, PointRange range) {
  return find_contact<CapsuleRoutine>(a, pose_a, b, pose_b, contact_threshold, previous_normal,
                                      range);
}

}  // namespace touchstone
