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

/// Counter-clockwise angle in [0, 2π) from p to q on a circle; 0 where rounding has put q a hair
/// behind p.
inline double angle_between(const Vec2& p, const Vec2& q) {
  constexpr double hair = 1e-7;
  const double angle = std::atan2(cross2(p, q), p.dot(q));
  return angle >= 0 ? angle : angle > -hair ? 0 : angle + 2 * std::numbers::pi;
}

struct Circle {
  Vec2 centre;
  double radius;
};

}  // namespace touchstone
