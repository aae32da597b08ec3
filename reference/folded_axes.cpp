#include "folded_axes.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "largest_gap.hpp"

namespace touchstone {

FoldedAxes::FoldedAxes(const Vec3& axis1, const Vec3& axis2, const Vec3& difference) {
  const double cosine = axis1.dot(axis2), side = std::copysign(1, cosine);
  c = without_vanishing(std::abs(cosine));
  // Component by component: Eigen would load in pairs what was just stored singly, which stalls.
  const double ux = axis1.x(), uy = axis1.y(), uz = axis1.z();
  const double x3 = uy * axis2.z() - uz * axis2.y(), y3 = uz * axis2.x() - ux * axis2.z();
  const double z3 = ux * axis2.y() - uy * axis2.x();
  s = std::sqrt(x3 * x3 + y3 * y3 + z3 * z3);
  constexpr double few_digits = 0.1;
  if (!(s > few_digits)) {
    e3 = Vec3(side * x3, side * y3, side * z3);
    fold_nearly_parallel(axis1, axis2, side, difference);
    return;
  }
  const double x2 = y3 * uz - z3 * uy, y2 = z3 * ux - x3 * uz, z2 = x3 * uy - y3 * ux;
  // Lengths are divided by last: until then nothing waits for the square root. Signs are multiplied
  // with, for which pose needs them is unpredictable.
  const double scale = side / s, dx = difference.x(), dy = difference.y(), dz = difference.z();
  d1 = without_vanishing(dx * ux + dy * uy + dz * uz);
  d2 = without_vanishing(scale * (dx * x2 + dy * y2 + dz * z2));
  d3 = without_vanishing(scale * (dx * x3 + dy * y3 + dz * z3));
  const double flip = std::copysign(1, d1 * (1 + c) + d2 * s), scale2 = flip * scale;
  const double scale3 = std::copysign(1, d3) * scale;
  d1 *= flip, d2 *= flip, d3 = std::abs(d3);
  e1 = Vec3(flip * ux, flip * uy, flip * uz);
  e2 = Vec3(scale2 * x2, scale2 * y2, scale2 * z2);
  e3 = Vec3(scale3 * x3, scale3 * y3, scale3 * z3);
}

// The product of nearly parallel axes has few digits left; across the first it must stay. What is
// then left along the second is lost in the second's own rounding.
void FoldedAxes::fold_nearly_parallel(const Vec3& u1, const Vec3& axis2, double side,
                                      const Vec3& difference) {
  const double ux = u1.x(), uy = u1.y(), uz = u1.z();
  const double dx = difference.x(), dy = difference.y(), dz = difference.z();
  const double along = dx * ux + dy * uy + dz * uz;
  double x = e3.x(), y = e3.y(), z = e3.z();
  constexpr double none = 1e-15;
  if (!(s > none)) {
    // Parallel: the plane of the axes is that which holds the centres.
    x = dx - along * ux, y = dy - along * uy, z = dz - along * uz;
    constexpr double digits = 1e-12, vanishing = 1e-100;
    const double squared = x * x + y * y + z * z, whole = dx * dx + dy * dy + dz * dz;
    if (!(squared > digits * digits * whole + vanishing * vanishing)) {
      const Vec3 any = u1.unitOrthogonal();
      x = any.x(), y = any.y(), z = any.z();
    }
  }
  const double rest = x * ux + y * uy + z * uz;
  x -= rest * ux, y -= rest * uy, z -= rest * uz;
  const double inverse = 1 / std::sqrt(x * x + y * y + z * z);
  x *= inverse, y *= inverse, z *= inverse;
  double x2 = y * uz - z * uy, y2 = z * ux - x * uz, z2 = x * uy - y * ux;
  s = side * (axis2.x() * x2 + axis2.y() * y2 + axis2.z() * z2);
  const double turn = std::copysign(1, s);
  s = std::abs(s);
  x2 *= turn, y2 *= turn, z2 *= turn;
  d1 = without_vanishing(along);
  d2 = without_vanishing(dx * x2 + dy * y2 + dz * z2);
  d3 = without_vanishing(dx * x + dy * y + dz * z);
  const double flip = std::copysign(1, d1 * (1 + c) + d2 * s), flip3 = std::copysign(1, d3);
  d1 *= flip, d2 *= flip, d3 = std::abs(d3);
  e1 = Vec3(flip * ux, flip * uy, flip * uz);
  e2 = Vec3(flip * x2, flip * y2, flip * z2);
  e3 = Vec3(flip3 * x, flip3 * y, flip3 * z);
}

}  // namespace touchstone
