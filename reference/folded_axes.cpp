#include "folded_axes.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "largest_gap.hpp"

namespace touchstone {

FoldedAxes::FoldedAxes(const Vec3& axis1, const Vec3& axis2, const Vec3& difference) {
  // Signs by multiplication: whether a pose needs them is anybody's guess, a branch would be too.
  // Lengths are divided by last: until then nothing waits for the square root.
  const double cosine = axis1.dot(axis2), side = std::copysign(1, cosine);
  e1 = axis1;
  e3 = e1.cross(axis2);
  e2 = e3.cross(e1);
  s = e3.norm();
  double scale = side / s;
  constexpr double few_digits = 0.1;
  if (!(s > few_digits)) {
    find_plane_of_nearly_parallel(scale, side * axis2, difference);
    scale = 1;
  }
  c = without_vanishing(std::abs(cosine));
  d1 = without_vanishing(difference.dot(e1));
  d2 = without_vanishing(scale * difference.dot(e2));
  d3 = without_vanishing(scale * difference.dot(e3));
  const double flip = std::copysign(1, d1 * (1 + c) + d2 * s);
  e3 *= std::copysign(scale, d3 * scale);
  d3 = std::abs(d3);
  d1 *= flip;
  d2 *= flip;
  e1 *= flip;
  e2 *= flip * scale;
}

// The product of nearly parallel axes has few digits left; across the first it must stay. What is
// then left along the second is lost in the second's own rounding.
void FoldedAxes::find_plane_of_nearly_parallel(double scale, const Vec3& u2,
                                               const Vec3& difference) {
  constexpr double none = 1e-15;
  if (s > none) {
    e3 *= scale;
  } else {
    // Parallel: the plane of the axes is that which holds the centres.
    const Vec3 across = difference - difference.dot(e1) * e1;
    const double distance = across.norm();
    constexpr double digits = 1e-12;
    e3 = distance > digits * difference.norm() ? Vec3(across / distance) : e1.unitOrthogonal();
  }
  e3 = (e3 - e3.dot(e1) * e1).normalized();
  e2 = e3.cross(e1);
  s = u2.dot(e2);
  if (s < 0) s = -s, e2 = -e2;
}

}  // namespace touchstone
