#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace touchstone {

// What contact patches are made of: the plane across a contact's normal.

using Vec2 = Eigen::Vector2d;

/// Counter-clockwise product x × y of two vectors of a plane.
inline double cross2(const Vec2& x, const Vec2& y) { return x.x() * y.y() - x.y() * y.x(); }
inline Vec2 turned_left(const Vec2& v) { return {-v.y(), v.x()}; }
inline Vec2 rotated(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}
/// Counter-clockwise angle from p to q in [0, 2π).
inline double angle_between(const Vec2& p, const Vec2& q) {
  const double angle = std::atan2(cross2(p, q), p.dot(q));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

struct Circle {
  Vec2 centre;
  double radius;
};

}  // namespace touchstone
