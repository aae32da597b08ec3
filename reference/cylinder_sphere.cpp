#include <algorithm>
#include <cmath>

#include "pair.hpp"

// The nearest point of the cylinder to the sphere's centre, or, with the centre inside, of its
// surface. How far the centre is beyond the nearer cap and beyond the side decides where that is:
//
//   on the cap   beyond it alone, or inside and no nearer to the side
//   on the side  beyond it alone, or inside and nearer to it
//   on the rim   beyond both

namespace touchstone {
namespace {

// Always inlined: with calls, an answer takes 14 ns instead of 9.

/// Squares of what is all but zero lose their digits.
constexpr double vanishing = 1e-140;

/// The unit vector along what of `across`, of length rho, is across the cylinder's axis.
[[gnu::always_inline]] inline Vec3 radial_direction(const PosedCylinder& a, const Vec3& across,
                                                    double rho, double z) {
  if (!(rho > vanishing)) return a.axes.col(0);
  Vec3 radial = (1 / rho) * across;
  constexpr double few_digits = 0.1;
  if (rho >= few_digits * std::abs(z)) return radial;
  // What rounding leaves along the axis counts.
  const Vec3 upright = radial - radial.dot(a.axis()) * a.axis();
  const double length = upright.norm();
  return length > 0.5 ? Vec3(upright / length) : Vec3(a.axes.col(0));
}

/// From the cylinder to a point, or the first clearance above `stop_above`.
[[gnu::always_inline]] inline SignedDistance to_point(const PosedCylinder& a, const Vec3& point,
                                                      double stop_above) {
  const Vec3 arm = point - a.centre;
  const double z = a.axis().dot(arm);
  const double outwards = std::copysign(1, z);  // along the axis, towards the point
  const double beyond_cap = std::abs(z) - a.half_length;
  if (beyond_cap > stop_above) return {beyond_cap, -outwards * a.axis()};
  const Vec3 across = arm - z * a.axis();
  const double rho = across.norm(), beyond_side = rho - a.radius;
  const bool off_the_rim = beyond_cap > 0 && beyond_side > 0;
  if (!off_the_rim && beyond_cap >= beyond_side) return {beyond_cap, -outwards * a.axis()};
  const Vec3 radial = radial_direction(a, across, rho, z);
  if (!off_the_rim) return {beyond_side, -radial};
  // Differences of lengths above 1e-25 (`are_in_range`): as far as they are not zero, their squares
  // keep their digits.
  const double distance = std::sqrt(beyond_cap * beyond_cap + beyond_side * beyond_side);
  return {distance,
          (-beyond_cap / distance * outwards) * a.axis() - (beyond_side / distance) * radial};
}

class SphereRoutine {
 public:
  SphereRoutine(const PosedCylinder& a, const PosedSphere& b) : a_(a), b_(b) {}

  [[gnu::always_inline]] SignedDistance find(double stop_above) const {
    SignedDistance found = to_point(a_, b_.centre, stop_above + b_.radius);
    found.value -= b_.radius;
    return found;
  }
  CertifiedDistance find_certified() const { return {find(no_early_exit), 0}; }

  void add_points(Contact& contact, const Vec3& origin, double, PointRange) const {
    // From the centre towards the cylinder: the sphere's surface, then half of the way between.
    const double way = b_.radius + contact.signed_distance / 2;
    contact.add_point(origin + way * contact.normal, -contact.signed_distance);
  }

 private:
  const PosedCylinder& a_;
  const PosedSphere& b_;
};

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                               const Pose& pose_b) {
  return find_signed_distance<SphereRoutine>(a, pose_a, b, pose_b);
}
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                                     const Pose& pose_b) {
  return find_certified_distance<SphereRoutine>(a, pose_a, b, pose_b);
}
bool overlaps(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b) {
  return find_overlap<SphereRoutine>(a, pose_a, b, pose_b);
}
Contact contact(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal, PointRange range) {
  return find_contact<SphereRoutine>(a, pose_a, b, pose_b, contact_threshold, previous_normal,
                                     range);
}

}  // namespace touchstone
