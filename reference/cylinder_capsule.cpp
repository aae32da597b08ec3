#include "cylinder_capsule.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ellipse_normal.hpp"
#include "folded_axes.hpp"
#include "largest_gap.hpp"
#include "pair_contact.hpp"
#include "scaled.hpp"

namespace touchstone {
namespace {

// The capsule less its radius is a segment, so the bodies touch at a cap (its end above it), where
// the sides cross, at the side (an end beside it), where the segment crosses a rim, or where an end
// is off the rim. In the folded frame each of these has one candidate, in closed form but for the
// segment over the rim, which is a point against an ellipse.
class Solver {
 public:
  Solver(const Cylinder& a, const Capsule& b, const FoldedAxes& f)
      : r1_(a.radius()), h1_(a.half_length()), h2_(b.half_length()), f_(f) {}

  /// Clearance to the segment, as far as closed forms tell it. True if they say it all, or it is
  /// more than `enough`.
  bool closed_forms(double enough) {
    cap();
    sides_crossing();
    if (!final_ && best_.gap <= enough) end_beside_side();
    return final_ || best_.gap > enough;
  }
  void search() {
    segment_over_rim();
    end_off_rim();
  }
  /// Tries every normal.
  void exhaust() {
    cap();
    sides_crossing();
    end_beside_side();
    search();
  }
  const LargestGap& best() const { return best_; }

 private:
  // Each says whether its normal is final: the segment meets a smooth place of the cylinder, its
  // depth away from the rims, so that a ball of that radius fits behind it.

  void cap() {
    const double side = std::copysign(1, f_.d1);
    best_.offer(std::abs(f_.d1) - h1_ - h2_ * f_.c, Vec3(side, 0, 0));
    const double y = f_.d2 - side * h2_ * f_.s, reach = r1_ - depth();
    final_ = depth() <= h1_ && reach >= 0 && y * y + f_.d3 * f_.d3 <= reach * reach;
  }

  void sides_crossing() {
    if (f_.d3 - r1_ <= best_.gap) return;
    best_.offer(f_.d3 - r1_, Vec3(0, 0, 1));
    constexpr double flat = 1e-15;
    if (f_.s <= flat) {  // side by side, e3 through both axes
      final_ = std::abs(f_.d2) <= flat * f_.d3 && on_side(std::max(0.0, std::abs(f_.d1) - h2_));
    } else {
      const double along = f_.d2 / f_.s;
      final_ = std::abs(along) <= h2_ && on_side(f_.d1 - f_.c * along);
    }
  }

  /// n ⟂ u1: the end towards A lies at (0, h2 s) across A's axis.
  void end_beside_side() {
    const double y = std::abs(f_.d2) - h2_ * f_.s;
    if (!(y > 0)) return;
    const double length = std::sqrt(y * y + f_.d3 * f_.d3);
    if (length - r1_ <= best_.gap) return;
    best_.offer(length - r1_, Vec3(0, std::copysign(y, f_.d2) / length, f_.d3 / length));
    final_ = on_side(f_.d1 - std::copysign(h2_, f_.d2) * f_.c);
  }

  double depth() const { return std::max(0.0, -best_.gap); }
  bool on_side(double along) const {
    const double delta = depth();
    return std::abs(along) <= h1_ - delta && delta <= r1_;
  }

  /// n ⟂ u2: seen along the segment the cap is an ellipse about the end of A's axis.
  void segment_over_rim() {
    const double along_k2 = f_.along_k2(f_.d());
    const double y = std::abs(along_k2) - h1_ * f_.s;
    const double b = r1_ * f_.c;
    // No direction is better than the distance from the ellipse's inscribed disc.
    if (f_.d3 * f_.d3 + y * y <= (best_.gap + b) * (best_.gap + b) && best_.gap + b > 0) return;
    // A point inside may be too far behind the chord of the ellipse's quadrant.
    if (r1_ * b - b * f_.d3 - r1_ * y >= std::max(0.0, -best_.gap) * (r1_ + b)) return;
    const auto n = ellipse_normal(r1_, b, f_.d3, y);
    if (!n) return;
    const double side = std::copysign(n->y(), along_k2);
    const double gap = n->x() * f_.d3 + n->y() * y -
                       std::sqrt(r1_ * r1_ * n->x() * n->x() + b * b * n->y() * n->y());
    best_.offer(gap, Vec3(-f_.s * side, f_.c * side, n->x()));
  }

  /// Only apart: the end that is nearest to the cylinder, beyond both cap and side.
  void end_off_rim() {
    for (const double end : {-h2_, h2_}) {
      const Vec3 q = f_.d() - end * Vec3(f_.c, f_.s, 0);
      const double above = std::abs(q.x()) - h1_;
      const double radial = std::sqrt(q.y() * q.y() + q.z() * q.z());
      const double beside = radial - r1_;
      if (!(above > 0 && beside > 0)) continue;
      const double distance = std::sqrt(above * above + beside * beside);
      if (distance <= best_.gap) continue;
      const Vec3 n =
          Vec3(std::copysign(above, q.x()), beside * q.y() / radial, beside * q.z() / radial) /
          distance;
      // The gap itself: the other end may be further along n.
      best_.offer(n.dot(f_.d()) - h2_ * std::abs(f_.along_u2(n)) - h1_ * std::abs(n.x()) -
                      r1_ * std::sqrt(n.y() * n.y() + n.z() * n.z()),
                  n);
    }
  }

  double r1_, h1_, h2_;
  const FoldedAxes& f_;
  LargestGap best_;
  bool final_ = false;
};

/// A normal with a clearance of clearly more than `enough`, of those along one axis and across
/// both: what most bodies that are apart need, before they are folded. `d` is A's centre less B's.
std::optional<SignedDistance> separation(const Cylinder& a, const Vec3& axis1, const Capsule& b,
                                         const Vec3& axis2, const Vec3& d, double enough) {
  const Vec3 cross = axis1.cross(axis2);
  const double c = std::abs(axis1.dot(axis2)), s = cross.norm();
  const double along1 = d.dot(axis1), along2 = d.dot(axis2), radii = a.radius() + b.radius();
  const double more =
      enough + clear_part * (d.cwiseAbs().sum() + a.half_length() + b.half_length() + radii);
  const double gap1 = std::abs(along1) - a.half_length() - b.half_length() * c - b.radius();
  const double gap2 =
      std::abs(along2) - a.half_length() * c - a.radius() * s - b.half_length() - b.radius();
  if (std::max(gap1, gap2) > more) {
    if (gap1 > gap2) return SignedDistance{gap1, std::copysign(1, along1) * axis1};
    return SignedDistance{gap2, std::copysign(1, along2) * axis2};
  }
  // The product of nearly parallel axes has few digits left.
  constexpr double few_digits = 0.1;
  const double across = d.dot(cross);
  if (s > few_digits && std::abs(across) > (radii + more) * s) {
    return SignedDistance{std::abs(across) / s - radii, (std::copysign(1, across) / s) * cross};
  }
  return std::nullopt;
}

/// Stops at the first direction with a clearance of more than `enough`.
SignedDistance solve(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b,
                     double enough) {
  const Vec3 axis1 = pose_a.axis(), axis2 = pose_b.axis();
  const Vec3 d = pose_a.position() - pose_b.position();
  if (enough < never) {
    if (const auto apart = separation(a, axis1, b, axis2, d, enough)) return *apart;
  }
  const FoldedAxes f(axis1, axis2, d);
  Solver solver(a, b, f);
  if (!solver.closed_forms(enough + b.radius())) solver.search();
  return {solver.best().gap - b.radius(), f.to_world(solver.best().normal)};
}

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Capsule& b,
                               const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return signed_distance(bodies...); }));
  }
  return solve(a, pose_a, b, pose_b, never);
}

CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Capsule& b,
                                     const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return certified_distance(bodies...); }));
  }
  const FoldedAxes f(pose_a.axis(), pose_b.axis(), pose_a.position() - pose_b.position());
  Solver solver(a, b, f);
  solver.exhaust();
  const double lengths =
      f.d().cwiseAbs().sum() + a.radius() + a.half_length() + b.radius() + b.half_length();
  return {{solver.best().gap - b.radius(), f.to_world(solver.best().normal)},
          rounding_part * lengths};
}

bool overlaps(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.ask([](const auto&... bodies) { return overlaps(bodies...); });
  }
  return solve(a, pose_a, b, pose_b, 0).value <= 0;
}

Contact contact(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal) {
  Contact result;
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    result = scaled.back(scaled.ask([&](const auto&... bodies) {
      return contact(bodies..., scaled.scaled(contact_threshold), previous_normal);
    }));
    return result;
  }
  const Vec3& origin = pose_b.position();
  make_contact(result, posed(a, pose_a, origin), posed(b, pose_b, origin),
               solve(a, pose_a, b, pose_b, contact_threshold), contact_threshold, origin,
               previous_normal);
  return result;
}

}  // namespace touchstone
