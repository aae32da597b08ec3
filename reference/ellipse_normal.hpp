#pragma once

#include <optional>

#include <Eigen/Core>

namespace touchstone {

/// A point (x, y) against the ellipse with half axes a >= b >= 0, a > 0, along the frame's axes.
///
/// The unit normal n, inside the first quadrant, at which x n_x + y n_y − √(a² n_x² + b² n_y²) has
/// a local maximum, if there is one. At its foot the ellipse is nearest to the point, from outside
/// or from inside. With x < 0 there is none. Accurate to about the square root of rounding at
/// worst, so that the maximum itself, which is flat there, is accurate to rounding.
std::optional<Eigen::Vector2d> ellipse_normal(double a, double b, double x, double y);

}  // namespace touchstone
