#pragma once

#include <vector>

#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// Points whose convex hull, seen along the unit vector n, is the part of a posed body (no plane)
/// within `epsilon` > 0 metres of its support plane along n. Curves are sampled, so the hull is
/// inscribed. Positions relative to `origin`; along n, those of spheres and capsules mean nothing.
std::vector<Vec3> support_part(const Shape& shape, const Pose& pose, const Vec3& n, double epsilon,
                               const Vec3& origin);

/// What of the part's widths there is only because epsilon is not zero: across a round side, a
/// tilted cap, an edge.
struct WidthFromEpsilon {
  double largest;    ///< metres; zero where a flat face lies in the part whole
  bool is_a_corner;  ///< no width is of another kind: the part shrinks to a point with epsilon
};
WidthFromEpsilon width_from_epsilon(const Shape& shape, const Pose& pose, const Vec3& n,
                                    double epsilon);

}  // namespace touchstone::oracle
