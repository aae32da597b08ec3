#pragma once

#include <cmath>

#include "largest_gap.hpp"
#include "shape.hpp"

namespace touchstone {

/// The frame of two axes, in which a pair of bodies of revolution needs five numbers only.
///
/// u1 = e1 and u2 = c e1 + s e2 with c, s >= 0 (an axis may be reversed, which changes no such
/// body); e3 is across both. The centre of A less that of B is d = d1 e1 + d2 e2 + d3 e3 with d3 >=
/// 0 and d·(u1 + u2) >= 0 (the sum of bodies of revolution is symmetric across the plane of the
/// axes and about the centre). So a largest gap lies at a normal with n3 >= 0.
struct FoldedAxes {
  double c, s;
  double d1, d2, d3;
  Vec3 e1, e2, e3;  ///< unit, in the world

  // Component by component throughout: Eigen would load in pairs what was just stored singly, which
  // stalls, and no compiler would make vectors of several pairs of bodies of it.

  struct Product {
    double side, cosine;   ///< the sign of the axes' product, ±1; the product's absolute value
    double x, y, z, sine;  ///< axis1 × axis2 and its length

    Product(const Vec3& axis1, const Vec3& axis2) {
      const double ux = axis1.x(), uy = axis1.y(), uz = axis1.z();
      const double vx = axis2.x(), vy = axis2.y(), vz = axis2.z();
      const double product = ux * vx + uy * vy + uz * vz;
      side = std::copysign(1, product), cosine = std::abs(product);
      x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      sine = std::sqrt(x * x + y * y + z * z);
    }
    /// Has the product enough digits?
    bool crosses() const { return sine > few_digits; }
  };

  FoldedAxes(const Vec3& axis1, const Vec3& axis2, const Vec3& d)
      : FoldedAxes(axis1, axis2, Product(axis1, axis2), d) {}
  FoldedAxes(const Vec3& axis1, const Vec3& axis2, const Product& product, const Vec3& d) {
    if (product.crosses()) [[likely]]
      fold_crossing(axis1, product, d);
    else
      fold_nearly_parallel(axis1, axis2, product, d);
  }
  /// Folds axes as if they crossed; what comes of nearly parallel ones, `crosses` tells apart.
  /// Branch-free, for batches.
  static FoldedAxes of_crossing_axes(const Vec3& axis1, const Vec3& axis2, const Vec3& d) {
    FoldedAxes f;
    f.fold_crossing(axis1, Product(axis1, axis2), d);
    return f;
  }
  /// Has the product of the axes enough digits?
  bool crosses() const { return s > few_digits; }

  Vec3 to_world(const Vec3& n) const { return n.x() * e1 + n.y() * e2 + n.z() * e3; }
  Vec3 d() const { return {d1, d2, d3}; }
  /// How far c² + s² is from one: the axes' lengths are rounded.
  double unit_error() const { return std::abs(c * c + s * s - 1); }
  /// Along u2, and across it within the plane of the axes (k2 = −s e1 + c e2).
  double along_u2(const Vec3& v) const { return c * v.x() + s * v.y(); }
  double along_k2(const Vec3& v) const { return c * v.y() - s * v.x(); }

  /// Where the line across both axes meets them, from the bodies' centres; infinite or NaN where
  /// the axes are parallel.
  struct Crossing {
    double t1, t2;
  };
  Crossing crossing() const {
    const double t2 = d2 / s;
    return {d1 - c * t2, t2};
  }

 private:
  static constexpr double few_digits = 0.1;  ///< a sine

  FoldedAxes() = default;
  void fold_crossing(const Vec3& u1, const Product& product, const Vec3& difference);
  void fold_nearly_parallel(const Vec3& u1, const Vec3& axis2, const Product& product,
                            const Vec3& difference);
};

[[gnu::always_inline]] inline void FoldedAxes::fold_crossing(const Vec3& u1, const Product& product,
                                                             const Vec3& difference) {
  c = without_vanishing(product.cosine), s = product.sine;
  const double ux = u1.x(), uy = u1.y(), uz = u1.z();
  const double x3 = product.x, y3 = product.y, z3 = product.z;
  const double x2 = y3 * uz - z3 * uy, y2 = z3 * ux - x3 * uz, z2 = x3 * uy - y3 * ux;
  // Lengths are divided by last: until then nothing waits for the square root. Signs are multiplied
  // with, for which pose needs them is unpredictable.
  const double scale = product.side / s;
  const double dx = difference.x(), dy = difference.y(), dz = difference.z();
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

}  // namespace touchstone
