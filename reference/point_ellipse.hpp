#pragma once

#include <array>

namespace touchstone {

/// Eccentric anomalies of the stationary distances from a point to the ellipse
/// (a cos t, b sin t), a >= b >= 0, a > 0, that can be local minima: the nearest point, and where
/// the point lies inside between the foci's normals, the one across the major axis (with the saddle
/// between). One to three angles; a point on the minor axis gives both of its mirror images.
struct EllipseFeet {
  std::array<double, 4> angle;
  int count = 0;
};

/// After folding into the first quadrant, the derivative over sin·cos is a x/cos t − b y/sin t −
/// (a² − b²): monotone where the nearest point lies, concave across the major axis; every root is
/// bracketed and found in a bounded number of steps. Compare Eberly, "Distance from a Point to an
/// Ellipse".
EllipseFeet feet_on_ellipse(double a, double b, double x, double y);

}  // namespace touchstone
