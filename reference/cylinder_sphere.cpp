#include "cylinder_sphere.hpp"

#include <algorithm>
#include <cmath>

#include "nearest_tie.hpp"
#include "scaled.hpp"

namespace touchstone {
namespace {

/// The sphere's centre about the cylinder.
struct Centre {
  Vec3 axial;   ///< unit, along the axis, towards the centre
  Vec3 radial;  ///< unit, off the axis, towards the centre
  double beyond_cap, beyond_side;
  /// Squares of what is all but zero lose their digits.
  static constexpr double vanishing = 1e-140;

  Centre(const Cylinder& a, const Pose& pose_a, const Pose& pose_b) {
    const Vec3 arm = pose_b.position() - pose_a.position();
    const Vec3 axis = pose_a.axis();
    const double z = axis.dot(arm);
    const Vec3 across = arm - z * axis;
    const double rho = across.norm();
    axial = std::copysign(1, z) * axis;
    radial = rho > vanishing ? Vec3((1 / rho) * across) : Vec3(pose_a.rotation().col(0));
    constexpr double few_digits = 0.1;
    if (rho < few_digits * std::abs(z)) {  // what rounding leaves along the axis counts
      radial -= radial.dot(axis) * axis;
      const double length = radial.norm();
      radial = length > 0.5 ? Vec3(radial / length) : Vec3(pose_a.rotation().col(0));
    }
    beyond_cap = std::abs(z) - a.half_length();
    beyond_side = rho - a.radius();
  }

  SignedDistance nearest() const {
    if (beyond_cap > 0 && beyond_side > 0) {
      const double distance = std::sqrt(beyond_cap * beyond_cap + beyond_side * beyond_side);
      if (!(distance > vanishing)) return {std::max(beyond_cap, beyond_side), -axial};
      return {distance, (-beyond_cap / distance) * axial - (beyond_side / distance) * radial};
    }
    return beyond_cap >= beyond_side ? SignedDistance{beyond_cap, -axial}
                                     : SignedDistance{beyond_side, -radial};
  }
};

Contact contact_in_range(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                         double contact_threshold, const Vec3* previous_normal) {
  SignedDistance found = Centre(a, pose_a, pose_b).nearest();
  found.value -= b.radius();
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
  SignedDistance result = Centre(a, pose_a, pose_b).nearest();
  result.value -= b.radius();
  return result;
}

bool overlaps(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b) {
  return signed_distance(a, pose_a, b, pose_b).value <= 0;
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
