#include "cylinder_sphere.hpp"

#include <algorithm>
#include <cmath>

#include "largest_gap.hpp"
#include "nearest_tie.hpp"
#include "scaled.hpp"

namespace touchstone {
namespace {

/// Squares of what is all but zero lose their digits.
constexpr double vanishing = 1e-140;

/// The unit vector along what of `across`, of length rho, is across the cylinder's axis.
Vec3 radial_direction(const Pose& cylinder, const Vec3& across, double rho, double z) {
  if (!(rho > vanishing)) return cylinder.rotation().col(0);
  Vec3 radial = (1 / rho) * across;
  constexpr double few_digits = 0.1;
  if (rho >= few_digits * std::abs(z)) return radial;
  // What rounding leaves along the axis counts.
  const Vec3 axis = cylinder.axis(), upright = radial - radial.dot(axis) * axis;
  const double length = upright.norm();
  return length > 0.5 ? Vec3(upright / length) : Vec3(cylinder.rotation().col(0));
}

/// From the cylinder to the sphere's centre, or the first clearance of more than `enough`.
SignedDistance to_centre(const Cylinder& a, const Pose& pose_a, const Pose& pose_b, double enough) {
  const Vec3 arm = pose_b.position() - pose_a.position();
  const Vec3 axis = pose_a.axis();
  const double z = axis.dot(arm);
  const double outwards = std::copysign(1, z);  // along the axis, towards the centre
  const double beyond_cap = std::abs(z) - a.half_length();
  if (beyond_cap > enough) return {beyond_cap, -outwards * axis};
  const Vec3 across = arm - z * axis;
  const double rho = across.norm(), beyond_side = rho - a.radius();
  const bool off_the_rim = beyond_cap > 0 && beyond_side > 0;
  if (!off_the_rim && beyond_cap >= beyond_side) return {beyond_cap, -outwards * axis};
  const Vec3 radial = radial_direction(pose_a, across, rho, z);
  if (!off_the_rim) return {beyond_side, -radial};
  const double distance = std::sqrt(beyond_cap * beyond_cap + beyond_side * beyond_side);
  if (!(distance > vanishing)) return {std::max(beyond_cap, beyond_side), -outwards * axis};
  return {distance, (-beyond_cap / distance * outwards) * axis - (beyond_side / distance) * radial};
}

/// Or the first clearance of more than `enough`.
SignedDistance distance(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                        double enough) {
  SignedDistance result = to_centre(a, pose_a, pose_b, enough + b.radius());
  result.value -= b.radius();
  return result;
}

Contact contact_in_range(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                         double contact_threshold, const Vec3* previous_normal) {
  SignedDistance found = distance(a, pose_a, b, pose_b, contact_threshold);
  if (previous_normal && found.value <= contact_threshold) {
    const Vec3& origin = pose_b.position();
    found = nearest_tie(posed(a, pose_a, origin), posed(b, pose_b, origin), found,
                        contact_threshold, *previous_normal);
  }
  Contact result;
  result.normal = found.normal;
  result.signed_distance = found.value;
  if (result.signed_distance <= contact_threshold) {
    // From the centre towards the cylinder: the sphere's surface, then half of the way between.
    result.add_point(pose_b.position() + (b.radius() + result.signed_distance / 2) * result.normal,
                     -result.signed_distance);
  }
  return result;
}

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                               const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return signed_distance(bodies...); }));
  }
  return distance(a, pose_a, b, pose_b, never);
}

CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                                     const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return certified_distance(bodies...); }));
  }
  const double lengths = (pose_a.position() - pose_b.position()).cwiseAbs().sum() + a.radius() +
                         a.half_length() + b.radius();
  return {signed_distance(a, pose_a, b, pose_b), rounding_part * lengths};
}

bool overlaps(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.ask([](const auto&... bodies) { return overlaps(bodies...); });
  }
  return distance(a, pose_a, b, pose_b, 0).value <= 0;
}

Contact contact(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(scaled.ask([&](const auto&... bodies) {
      return contact(bodies..., scaled.scaled(contact_threshold), previous_normal);
    }));
  }
  return contact_in_range(a, pose_a, b, pose_b, contact_threshold, previous_normal);
}

}  // namespace touchstone
