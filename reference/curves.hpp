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

/// Whether the point lies across the major axis and beyond the chord of the ellipse's evolute: then
/// what `ellipse_normal` maximises falls all the way from (1, 0) to (0, 1).
inline bool is_beyond_evolute(double a, double b, double x, double y) {
  return y <= 0 && a * x - b * y >= (a - b) * (a + b);
}

/// Unit normals of the first quadrant from `first` on, by their angle from (1, 0), to `last`, or
/// without it to (0, 1).
struct NormalArc {
  Vec2 first = Vec2(1, 0);
  std::optional<Vec2> last;
};

/// By how much x m_x + y m_y − √(a² m_x² + b² m_y²), x >= 0, may exceed −depth for a unit m on an
/// arc, rounding included. It must not do so for n nor the arc's first and last, if they lie on it.
/// Where n is the foot's normal or none, as `ellipse_normal` says, that is all but nothing
/// (proofs.md, "Rounding of a certified distance").
double ellipse_excess(double a, double b, double x, double y, const std::optional<Vec2>& n,
                      double depth, const NormalArc& arc = {});

}  // namespace touchstone
