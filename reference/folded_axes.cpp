#include "folded_axes.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "largest_gap.hpp"

namespace touchstone {

FoldedAxes::FoldedAxes(const Vec3& axis1, const Vec3& axis2, const Vec3& difference) {
  // Signs by multiplication: whether a pose needs them is anybody's guess, a branch would be too.
  const Vec3 u2 = std::copysign(1, axis1.dot(axis2)) * axis2;
  e1 = axis1;
  e3 = e1.cross(u2);
  double length = e3.norm();
  // The product of nearly parallel axes has few digits left; across the first it must stay. What
  // is then left along the second is lost in the second's own rounding.
  constexpr double few_digits = 0.1, none = 1e-15;
  if (length > none) {
    e3 *= 1 / length;
    if (length < few_digits) e3 = (e3 - e3.dot(e1) * e1).normalized();
  } else {
    // Parallel: the plane of the axes is that which holds the centres.
    const Vec3 across = difference - difference.dot(e1) * e1;
    length = across.norm();
    constexpr double digits = 1e-12;
    e3 = length > digits * difference.norm() ? Vec3(across / length) : e1.unitOrthogonal();
    e3 = (e3 - e3.dot(e1) * e1).normalized();
  }
  e2 = e3.cross(e1);
  c = u2.dot(e1);
  s = u2.dot(e2);
  if (s < 0) s = -s, e2 = -e2;
  d1 = without_vanishing(difference.dot(e1));
  d2 = without_vanishing(difference.dot(e2));
  d3 = without_vanishing(difference.dot(e3));
  e3 *= std::copysign(1, d3);
  d3 = std::abs(d3);
  const double flip = std::copysign(1, d1 * (1 + c) + d2 * s);
  d1 *= flip;
  d2 *= flip;
  e1 *= flip;
  e2 *= flip;
}

}  // namespace touchstone
