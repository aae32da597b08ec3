#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Core>

namespace touchstone {

// Vectors of a plane, and the curves that cylinders show there: circles, and ellipses at a slant.

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

/// A point (x, y) against the ellipse with half axes a >= b >= 0, a > 0, along the frame's axes.
///
/// The unit normal n, inside the first quadrant, at which x n_x + y n_y − √(a² n_x² + b² n_y²) has
/// a local maximum, if there is one. At its foot the ellipse is nearest to the point, from outside
/// or from inside. With x < 0 there is none. Accurate to about the square root of rounding at
/// worst, so that the maximum itself, which is flat there, is accurate to rounding.
std::optional<Vec2> ellipse_normal(double a, double b, double x, double y);

}  // namespace touchstone
