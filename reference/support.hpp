#pragma once

#include "configuration.hpp"

namespace touchstone {

/// Support h(n) = max over the posed body of x·n, in metres, for a unit n in the world frame.
/// Infinite for a plane unless n is its outward normal to the last bit.
double support(const Shape& shape, const Pose& pose, const Vec3& n);

/// g(n) = min over A of a·n − max over B of b·n: the clearance along the unit vector n, in double
/// precision (rounding of a few ulp of the coordinates). The signed distance is its maximum over n.
double gap(const Configuration& configuration, const Vec3& n);

}  // namespace touchstone
