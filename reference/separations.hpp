#pragma once

#include <algorithm>
#include <cmath>

#include "folded_axes.hpp"
#include "largest_gap.hpp"

namespace touchstone {

// Clearances along the few normals that tell most bodies apart which are: closed forms without a
// branch, for the routines of single pairs and for those of many at once (batch.cpp).

/// Of two cylinders: the best of the normals along either axis and across both.
struct CapsAndSides {
  double cap1, cap2, sides, gap;
  double side1, side2;  ///< ±1: whether cap 1 (2) has its normal along u1 (u2) or against it
  double c, s;

  CapsAndSides(const FoldedAxes& f, double r1, double h1, double r2, double h2) : c(f.c), s(f.s) {
    const double along2 = f.c * f.d1 + f.s * f.d2;
    cap1 = std::abs(f.d1) - h1 - h2 * f.c - r2 * f.s;
    cap2 = std::abs(along2) - h2 - h1 * f.c - r1 * f.s;
    sides = f.d3 - r1 - r2;
    gap = std::max(std::max(cap1, cap2), sides);
    side1 = std::copysign(1, f.d1), side2 = std::copysign(1, along2);
  }
  /// Branch-free: the winner is unpredictable.
  StageResult without_proof() const {
    const double is1 = gap == cap1 ? 1 : 0, is3 = gap == sides ? 1 - is1 : 0;
    const double is2 = side2 * (1 - is1 - is3);
    return {gap, side1 * is1 + is2 * c, is2 * s, is3};
  }
};

/// Of a cylinder and a capsule: along the cylinder's axis, along the capsule's, and across both.
struct CapsuleClearances {
  double along1, along2;  ///< from the capsule's centre to the cylinder's, along their axes
  Vec3 product;           ///< of the axes
  double sine, across;    ///< its length; from centre to centre along it, times the sine
  double gap1, gap2, radii;
  double more;  ///< a clearance of clearly more than was asked for

  /// `d` is the cylinder's centre less the capsule's, `u` and `v` are their axes.
  CapsuleClearances(const Vec3& d, const Vec3& u, const Vec3& v, double r1, double h1, double r2,
                    double h2, double stop_above)
      : product(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(),
                u.x() * v.y() - u.y() * v.x()) {
    // Component by component, as in FoldedAxes.
    const double x = product.x(), y = product.y(), z = product.z();
    const double c = std::abs(u.x() * v.x() + u.y() * v.y() + u.z() * v.z());
    sine = std::sqrt(x * x + y * y + z * z);
    along1 = d.x() * u.x() + d.y() * u.y() + d.z() * u.z();
    along2 = d.x() * v.x() + d.y() * v.y() + d.z() * v.z();
    across = d.x() * x + d.y() * y + d.z() * z;
    gap1 = std::abs(along1) - h1 - h2 * c - r2;
    gap2 = std::abs(along2) - h1 * c - r1 * sine - h2 - r2;
    radii = r1 + r2;
    const double sum = std::abs(d.x()) + std::abs(d.y()) + std::abs(d.z());
    more = stop_above + clear_part * (sum + h1 + h2 + radii);
  }
  bool is_apart_along_axis() const { return std::max(gap1, gap2) > more; }
  /// The product of nearly parallel axes has few digits left.
  bool is_apart_across() const {
    constexpr double few_digits = 0.1;
    return (sine > few_digits) & (std::abs(across) > (radii + more) * sine);
  }
  double gap_across() const { return std::abs(across) / sine - radii; }
  /// What makes a unit normal of the product.
  double scale_across() const { return std::copysign(1, across) / sine; }
};

}  // namespace touchstone
