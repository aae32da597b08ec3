#pragma once

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

  FoldedAxes(const Vec3& axis1, const Vec3& axis2, const Vec3& d);

  Vec3 to_world(const Vec3& n) const { return n.x() * e1 + n.y() * e2 + n.z() * e3; }
  Vec3 d() const { return {d1, d2, d3}; }
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
  /// `side` is the sign of the axes' product, s the length of u1 × axis2, and e3 is along that
  /// times the sign.
  void fold_nearly_parallel(const Vec3& u1, const Vec3& axis2, double side, const Vec3& difference);
};

}  // namespace touchstone
