#pragma once

#include <cmath>

#include "contact.hpp"
#include "posed_body.hpp"

namespace touchstone {

// The signed distances that are a formula, of a plane and of a sphere: for one pair of poses
// (cylinder_plane.cpp, cylinder_sphere.cpp) and for many (batch.cpp).

/// A cylinder over a half-space, whose normal is the only one.
struct OverPlane {
  double x, y, cosine;  ///< the plane's normal in the cylinder's frame
  double sine;          ///< not from the cosine, which hides a small tilt
  double height;        ///< of the cylinder's centre above the plane

  OverPlane(const PosedCylinder& a, const PosedPlane& b)
      : x(a.axes.col(0).dot(b.normal)),
        y(a.axes.col(1).dot(b.normal)),
        cosine(a.axes.col(2).dot(b.normal)),
        sine(std::sqrt(x * x + y * y)),
        height(b.normal.dot(a.centre - b.centre) - b.displacement) {}
  /// Of the deepest point, on the rim of the lower cap.
  double distance(const PosedCylinder& a) const {
    return height - a.half_length * std::abs(cosine) - a.radius * sine;
  }
};

inline SignedDistance closed_form(const PosedCylinder& a, const PosedPlane& b, double) {
  return {OverPlane(a, b).distance(a), b.normal};
}

// A sphere: the nearest point of the cylinder to its centre, or, with the centre inside, of its
// surface. How far the centre is beyond the nearer cap and beyond the side decides where that is:
//
//   on the cap   beyond it alone, or inside and no nearer to the side
//   on the side  beyond it alone, or inside and nearer to it
//   on the rim   beyond both
//
// Always inlined: with calls, an answer takes 14 ns instead of 9.

/// The unit vector along what of `across`, of length rho, is across the cylinder's axis.
[[gnu::always_inline]] inline Vec3 radial_direction(const PosedCylinder& a, const Vec3& across,
                                                    double rho, double z) {
  constexpr double vanishing = 1e-140;  // squares of what is all but zero lose their digits
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

/// The signed distance, or the first clearance above `stop_above`.
[[gnu::always_inline]] inline SignedDistance closed_form(const PosedCylinder& a,
                                                         const PosedSphere& b, double stop_above) {
  SignedDistance found = to_point(a, b.centre, stop_above + b.radius);
  found.value -= b.radius;
  return found;
}

}  // namespace touchstone
