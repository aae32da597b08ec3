#include "folded_axes.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace touchstone {

// The product of nearly parallel axes has few digits left; across the first it must stay. What is
// then left along the second is lost in the second's own rounding.
void FoldedAxes::fold_nearly_parallel(const Vec3& u1, const Vec3& axis2, const Product& product,
                                      const Vec3& difference) {
  c = without_vanishing(product.cosine), s = product.sine;
  const double side = product.side;
  const double ux = u1.x(), uy = u1.y(), uz = u1.z();
  const double dx = difference.x(), dy = difference.y(), dz = difference.z();
  const double along = dx * ux + dy * uy + dz * uz;
  double x = side * product.x, y = side * product.y, z = side * product.z;
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
