#pragma once

#include <optional>

#include "reference/shape.hpp"

namespace touchstone::oracle {

/// Any shape but a plane in its own frame, metres: a core ⊕ a ball. The core is a box ⊕ a disc
/// across the z axis, each of which may be a segment or a point; or it is a hull.
struct Body {
  // Of box and disc. The core's sizes, of those that are not zero, are smaller by the inset.
  Vec3 half_extents = Vec3::Zero();
  double disc_radius = 0;
  double inset = 0;
  double ball_radius = 0;
  std::optional<Convex> hull;

  /// All zero for a plane.
  explicit Body(const Shape& shape);

  /// Is it one about its z axis, a cylinder or a capsule?
  bool is_round() const { return half_extents.x() == 0 && half_extents.z() > 0; }
  /// What the inset leaves of a size, in any numbers that doubles can be converted to.
  template <class Number = double>
  Number of_core(double size) const {
    return size > 0 ? Number(Number(size) - Number(inset)) : Number(0);
  }
  Vec3 core_half_extents() const {
    return half_extents.unaryExpr([this](double size) { return of_core(size); });
  }
  double core_radius() const { return of_core(disc_radius); }
  /// How far the core reaches along n, of any length, beyond `from`; that is zero but for a hull.
  double core_reach(const Vec3& n, const Vec3& from = Vec3::Zero()) const;
};

}  // namespace touchstone::oracle
