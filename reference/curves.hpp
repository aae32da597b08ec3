#pragma once

#include <algorithm>
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

/// The number of an interval that is nearest to x; of an empty one, `lo`.
inline double within(double x, double lo, double hi) { return std::max(lo, std::min(x, hi)); }
/// From 0 where x is `from` to 1 where it is `to`, and no farther.
inline double ramp(double x, double from, double to) {
  return within((x - from) / (to - from), 0, 1);
}

struct Circle {
  Vec2 centre;
  double radius;
};

/// The points of a plane with |across·p − middle| <= half_width: what lies between two opposite
/// edges of a face.
struct Strip {
  Vec2 across;
  double middle, half_width;
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

/// Two chords of the ellipse's quadrant meet at (a, b)/√2: is the point (x, y) further behind both
/// than this depth?
inline bool is_behind_chords(double a, double b, double x, double y, double depth) {
  constexpr double mid = std::numbers::sqrt2 - 1;
  const double across = a * b - b * x - a * mid * y, along = a * b - b * mid * x - a * y;
  const double squared = depth * depth;
  return across > 0 && across * across >= squared * (b * b + mid * mid * a * a) && along > 0 &&
         along * along >= squared * (a * a + mid * mid * b * b);
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
