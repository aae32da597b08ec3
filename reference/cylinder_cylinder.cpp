#include <algorithm>
#include <cmath>
#include <optional>

#include "curves.hpp"
#include "deep_normals.hpp"
#include "largest_gap.hpp"
#include "pair.hpp"
#include "rims.hpp"

// The largest gap lies at one normal of four kinds. In the frame of both axes they are
//
//   caps_and_sides  along an axis (a cap), or across both (the sides cross): closed forms
//   side_and_rim    across one axis, for each of both: the other's rim beside the side, which is a
//                   point against an ellipse, seen along the axis
//   rims            neither: the rims are scanned (rim_rim.hpp)
//
// The best of the first two kinds is mostly proven, because a smooth place of one body is met well
// within its bounds: where the bodies overlap by δ, a ball of radius δ fits into that body behind
// the place, so that no way out is shorter than δ. Deeper ones are bounded in deep_normals.hpp.

namespace touchstone {
namespace {

constexpr double flat = 1e-15;  // sine of an angle that counts as none

/// Does a point of a side, so far along the axis, lie its depth away from the ends?
bool is_within_side(double along, double r, double h, double gap) {
  return std::abs(along) <= h - depth(gap) && depth(gap) <= r;
}

/// Does the point of a rim at which it meets a side lie its depth away from the side's ends, and no
/// further from the axis than the gap says? Along a normal that is also the rim's own axis, but for
/// rounding, the rim's furthest point is any of it, and the one that the formula takes may be
/// another one than that which faces the side.
bool is_proven_at_rim(const FoldedCylinders& p, const FoldedCylinders::FromAxis& point, double r,
                      double h, double gap) {
  const double reach = r + gap + p.proof_rounding();
  return is_within_side(point.along, r, h, gap) && point.squared <= reach * reach;
}

/// Has a cap the largest gap? The other's centre lies at `offset` across the cap's axis, towards
/// which the middle of the other's rim lies at ±H s from there, and the rim's point at ∓R c.
bool is_proven_at_cap(const FoldedAxes& f, double gap, double offset, double side,
                      const AboutAxis& x) {
  const double delta = depth(gap);
  double across = 0, reach = x.r - delta;
  if (x.s <= flat) {  // cap on cap: any shared point
    across = offset;
    reach += x.R;
  } else if (x.c <= flat) {  // a generator on the cap: any of its points
    across = std::max(0.0, std::abs(offset) - x.H);
  } else {
    across = offset - side * (x.H * x.s - x.R * x.c);
  }
  const double squared = across * across + f.d3 * f.d3;
  // A point of the other that faces the cap lies on it, its depth away from the cap's rim.
  if (delta <= x.h && delta <= x.r && squared <= reach * reach) return true;
  if (gap > 0) return false;
  if (no_normal_beats_cap(x, delta)) return true;
  const double holds = x.s > flat ? x.r : x.r + x.R;
  if (no_normal_beats_held_cap(x, std::sqrt(squared), holds, delta)) return true;
  return squared <= x.r * x.r && x.s > flat &&
         bends_away_near_axis({x.R, x.H}, {x.r, x.h}, x.s, f.d3 * f.d3 / squared, delta, 0, x);
}

bool is_proven_at_cap1(const FoldedCylinders& p, double gap, double side) {
  const FoldedAxes& f = p.axes;
  const double across = std::sqrt(f.d2 * f.d2 + f.d3 * f.d3);
  return is_proven_at_cap(f, gap, f.d2, side,
                          {p.r1, p.h1, p.r2, p.h2, f.c, f.s, std::abs(f.d1), across});
}

/// Seen from u2, u1 leans the other way.
bool is_proven_at_cap2(const FoldedCylinders& p, double gap, double side) {
  const FoldedAxes& f = p.axes;
  const double along = f.along_u2(f.d()), offset = -f.along_k2(f.d());
  const double across = std::sqrt(offset * offset + f.d3 * f.d3);
  return is_proven_at_cap(f, gap, offset, side,
                          {p.r2, p.h2, p.r1, p.h1, f.c, f.s, std::abs(along), across});
}

/// Do the generators cross within both, one of them further from its ends than the depth?
bool is_proven_at_sides(const FoldedCylinders& p, double gap) {
  const FoldedAxes& f = p.axes;
  if (f.s <= flat) {  // side by side, e3 through both axes: any generator's point that they share
    return std::abs(f.d2) <= flat * f.d3 &&
           is_within_side(std::max(0.0, std::abs(f.d1) - p.h2), p.r1, p.h1, gap);
  }
  const auto [t1, t2] = f.crossing();
  if (std::abs(t1) > p.h1 || std::abs(t2) > p.h2) return false;
  return is_within_side(t1, p.r1, p.h1, gap) || is_within_side(t2, p.r2, p.h2, gap) ||
         no_normal_beats_crossing(p);
}

StageResult caps_and_sides(const FoldedCylinders& p, double stop_above) {
  const FoldedAxes& f = p.axes;
  const CapsAndSides best(f, p.r1, p.h1, p.r2, p.h2);
  const double gap = best.gap, side1 = best.side1, side2 = best.side2;
  if (gap > stop_above) return best.without_proof();
  if (gap == best.cap1) return {gap, side1, 0, 0, is_proven_at_cap1(p, gap, side1)};
  if (gap == best.cap2) {
    return {gap, side2 * f.c, side2 * f.s, 0, is_proven_at_cap2(p, gap, side2)};
  }
  return {gap, 0, 0, 1, is_proven_at_sides(p, gap)};
}

/// A cylinder's rim beside another one's side, seen along the side's axis: the rim is an ellipse
/// with the half axes r and r c, its middle y from the axis within the plane of the axes, and d3
/// off it.
struct RimBesideSide {
  double y, d3, rim_radius, side_radius, c;

  double inscribed() const { return rim_radius * c; }
  double squared() const { return d3 * d3 + y * y; }
  /// Is every normal that reaches the rim here clearly above `stop_above`?
  bool is_far(double stop_above) const {
    const double least = stop_above + side_radius + inscribed();
    return y > 0 && squared() > least * least;
  }
  /// About the way to the nearest point of the ellipse, by its parts along d3 and y; unit.
  Vec2 about_normal() const {
    const double distance = std::sqrt(squared()), b = inscribed();
    const double tau = rim_radius * std::max(0.0, distance - rim_radius);
    const Vec2 n((b * b + tau) * d3, (rim_radius * rim_radius + tau) * y);
    return (1 / n.norm()) * n;
  }
  /// Is no gap of a normal that reaches the rim here above `best`?
  bool is_no_better_than(double best) const {
    // No direction is better than the distance from the ellipse's inscribed disc.
    const double b = inscribed(), bound = best + side_radius + b;
    if (bound > 0 && squared() <= bound * bound) return true;
    // A point inside may be too far behind the chord of the ellipse's quadrant.
    return rim_radius * b - b * d3 - rim_radius * y >=
           std::max(0.0, -best - side_radius) * (rim_radius + b);
  }
  /// The normal at the nearest point, unless its gap cannot be above `best`.
  std::optional<Vec2> normal(double best) const {
    if (is_no_better_than(best)) return std::nullopt;
    return ellipse_normal(rim_radius, inscribed(), d3, y);
  }
  /// By how much another normal may be better than the best of all that were tried.
  double missed(double best) const {
    if (is_no_better_than(best)) return 0;
    const double b = inscribed();
    return ellipse_excess(rim_radius, b, d3, y, ellipse_normal(rim_radius, b, d3, y),
                          -best - side_radius);
  }
};
RimBesideSide rim2_beside_side1(const FoldedCylinders& p) {
  const FoldedAxes& f = p.axes;
  return {std::abs(f.d2) - p.h2 * f.s, f.d3, p.r2, p.r1, f.c};
}
RimBesideSide rim1_beside_side2(const FoldedCylinders& p) {
  const FoldedAxes& f = p.axes;
  return {std::abs(f.along_k2(f.d())) - p.h1 * f.s, f.d3, p.r1, p.r2, f.c};
}
/// In the folded frame, of a normal across axis 1 with these parts along d3 and y; across axis 2.
Vec3 across_axis1(const FoldedAxes& f, const Vec2& n) {
  return {0, std::copysign(n.y(), f.d2), n.x()};
}
Vec3 across_axis2(const FoldedAxes& f, const Vec2& n) {
  const double side = std::copysign(n.y(), f.along_k2(f.d()));
  return {-f.s * side, f.c * side, n.x()};
}

/// A normal about from one side to the nearest end of the other axis with a gap of clearly more
/// than `stop_above`: mostly there is one where bodies are apart by more than a little.
StageResult separation_beside(const FoldedCylinders& p, double stop_above) {
  const auto tried = [&](const Vec3& n) -> StageResult {
    const double gap = p.gap(n);
    if (!(gap > stop_above + p.clear_gap())) return {};
    return {gap, n.x(), n.y(), n.z()};
  };
  if (const RimBesideSide rim2 = rim2_beside_side1(p); rim2.is_far(stop_above)) {
    const StageResult found = tried(across_axis1(p.axes, rim2.about_normal()));
    if (found.gap > stop_above) return found;
  }
  const RimBesideSide rim1 = rim1_beside_side2(p);
  if (!rim1.is_far(stop_above)) return {};
  return tried(across_axis2(p.axes, rim1.about_normal()));
}

StageResult side1_and_rim2(const FoldedCylinders& p, double best) {
  const auto way = rim2_beside_side1(p).normal(best);
  if (!way) return {};
  const Vec3 n = across_axis1(p.axes, *way);
  const double gap = p.gap(n);
  if (!(gap > best)) return {};
  return {gap, n.x(), n.y(), n.z(), is_proven_at_rim(p, p.from_axis1(n), p.r1, p.h1, gap)};
}
StageResult side2_and_rim1(const FoldedCylinders& p, double best) {
  const auto way = rim1_beside_side2(p).normal(best);
  if (!way) return {};
  const Vec3 n = across_axis2(p.axes, *way);
  const double gap = p.gap(n);
  if (!(gap > best)) return {};
  return {gap, n.x(), n.y(), n.z(), is_proven_at_rim(p, p.from_axis2(n), p.r2, p.h2, gap)};
}

/// The largest gap but where rims meet.
StageResult largest_gap_beside_rims(const FoldedCylinders& p, EarlyExit exit) {
  StageResult best = caps_and_sides(p, exit.stop_above);
  if (exit.ends_with(best)) return best;
  if (exit.stop_above < no_early_exit) {
    const StageResult apart = separation_beside(p, exit.stop_above);
    if (exit.ends_with(apart)) return apart;
  }
  best.improve(side1_and_rim2(p, best.gap));
  if (exit.ends_with(best)) return best;
  best.improve(side2_and_rim1(p, best.gap));
  return best;
}

/// A cap of one of two cylinders whose axes are nearly parallel, which may meet the other one.
/// About the middle between the centres either looks the same, so that the way from B to A serves
/// both.
struct FacingCap {
  const PosedCylinder &own, &other;
  const FoldedAxes::Product& axes;  ///< of both axes, in either order
  double along, x, y, z;            ///< the way's parts along the own axis and across it
  double gap;                       ///< along the own axis

  FacingCap(const PosedCylinder& o, const PosedCylinder& p, const FoldedAxes::Product& product,
            const Vec3& d)
      : own(o), other(p), axes(product) {
    const auto u = own.axis();
    along = d.x() * u.x() + d.y() * u.y() + d.z() * u.z();
    x = d.x() - along * u.x(), y = d.y() - along * u.y(), z = d.z() - along * u.z();
    gap = std::abs(along) - own.half_length - axes.cosine * other.half_length -
          axes.sine * other.radius;
  }
  /// Is it larger than the gap across the axes, if these were parallel?
  bool exceeds_sides() const {
    const double beyond = gap + own.radius + other.radius;
    return beyond > 0 && beyond * beyond > x * x + y * y + z * z;
  }
  /// Does the other's deepest point lie on the cap, its depth away from the rim; of parallel axes,
  /// any point of its cap?
  bool is_proven() const {
    const double delta = depth(gap), reach = own.radius - delta;
    if (!(delta <= own.half_length && reach >= 0)) return false;
    if (axes.sine <= flat) {
      return x * x + y * y + z * z <= (reach + other.radius) * (reach + other.radius);
    }
    // Across the own axis that point lies from the other's centre as the other axis does, at the
    // end of that axis and at the rim on the other side. What rounding leaves of the other axis
    // there has neither the direction nor the length of the product of the axes; it is scaled by
    // its own length, so that the point lies on the rim whatever its direction.
    const auto u = own.axis(), v = other.axis();
    const double along_u = axes.side * axes.cosine;
    const double vx = v.x() - along_u * u.x(), vy = v.y() - along_u * u.y();
    const double vz = v.z() - along_u * u.z();
    const double length = std::sqrt(vx * vx + vy * vy + vz * vz);
    const double scale = std::copysign(1, along) * axes.side *
                         (other.half_length - other.radius * axes.cosine / length);
    const double px = scale * vx - x, py = scale * vy - y, pz = scale * vz - z;
    return px * px + py * py + pz * pz <= reach * reach;
  }
  LargestGap largest_gap() const {
    const auto u = own.axis();
    const double side = std::copysign(1, along);
    return {gap, Vec3(side * u.x(), side * u.y(), side * u.z())};
  }
};

/// The largest gap of bodies that stand on each other, where a cap along a nearly parallel axis
/// is proven as it is: no frame has to be made.
std::optional<LargestGap> standing(const PosedCylinder& a, const PosedCylinder& b,
                                   const FoldedAxes::Product& axes, const Vec3& d,
                                   double stop_above) {
  const FacingCap on_a(a, b, axes, d);
  if (!on_a.exceeds_sides()) return std::nullopt;
  const FacingCap on_b(b, a, axes, d);
  const FacingCap& best = on_a.gap >= on_b.gap ? on_a : on_b;
  if (!(best.gap > stop_above || best.is_proven())) return std::nullopt;
  return best.largest_gap();
}

/// Rounding makes what a proof says wrong by at most this (proofs.md, "Rounding of a certified
/// distance").
double what_proofs_round(const FoldedCylinders& p) {
  constexpr double part = 40 * unit_roundoff;
  return (part + p.axes.unit_error()) * p.lengths();
}

/// `a` has the smaller radius or the same.
CertifiedDistance find_largest(const PosedCylinder& a, const PosedCylinder& b, EarlyExit exit) {
  const FoldedAxes::Product axes(a.axis(), b.axis());
  const Vec3 d = a.centre - b.centre;
  if (exit.trusts_proofs && !axes.crosses()) {
    if (const auto found = standing(a, b, axes, d, exit.stop_above))
      return {{found->gap, found->normal}, 0};
  }
  const FoldedCylinders p{FoldedAxes(a.axis(), b.axis(), axes, d), a.radius, a.half_length,
                          b.radius, b.half_length};
  const StageResult found = largest_gap_beside_rims(p, exit);
  if (exit.ends_with(found)) return {{found.gap, p.axes.to_world(found.normal())}, 0};
  LargestGap best{found.gap, found.normal()};
  if (exit.trusts_proofs) {
    offer_rim_rim_normals(p, exit.stop_above, best);
    return {{best.gap, p.axes.to_world(best.normal)}, 0};
  }
  const double in_proofs = what_proofs_round(p);
  double missed = search_all_rims(p, best);
  if (!found.is_proven) {
    missed = std::max(
        {missed, rim2_beside_side1(p).missed(best.gap), rim1_beside_side2(p).missed(best.gap)});
  }
  if (missed > in_proofs && (found.is_proven || is_proven_where_rims_meet(p, best))) {
    missed = in_proofs;
  }
  return {{best.gap, p.axes.to_world(best.normal)}, missed + p.axes.unit_error() * p.lengths()};
}

using CylinderRoutine = SearchRoutine<PosedCylinder, find_largest>;

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                               const Pose& pose_b) {
  return find_signed_distance<CylinderRoutine>(a, pose_a, b, pose_b);
}
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                                     const Pose& pose_b) {
  return find_certified_distance<CylinderRoutine>(a, pose_a, b, pose_b);
}
bool overlaps(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b) {
  return find_overlap<CylinderRoutine>(a, pose_a, b, pose_b);
}
Contact contact(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal, PointRange range) {
  return find_contact<CylinderRoutine>(a, pose_a, b, pose_b, contact_threshold, previous_normal,
                                       range);
}

}  // namespace touchstone
