#include <algorithm>
#include <cmath>
#include <optional>

#include "cylinder_segment.hpp"
#include "pair.hpp"

namespace touchstone {
namespace {

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
  const FoldedSegment p{FoldedAxes(a.axis(), b.axis(), d), a.radius, a.half_length, b.half_length};
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
