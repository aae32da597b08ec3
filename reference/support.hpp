#pragma once

#include "configuration.hpp"

namespace touchstone {

/// Support h(n) = max over the posed body of x·n, in metres, for a unit n in the world frame.
/// Infinite for a plane unless n is its outward normal to the last bit.
double support(const Shape& shape, const Pose& pose, const Vec3& n);

/// g(n) = min over A of a·n − max over B of b·n: the clearance along the unit vector n, in double
/// precision (rounding of a few ulp of the coordinates). The signed distance is its maximum over n.
double gap(const Configuration& configuration, const Vec3& n);

/// An axis-aligned box of the world, metres: what a coarse step sorts bodies by.
struct Aabb {
  Vec3 lower, upper;
  bool overlaps(const Aabb& other) const {
    return (lower.array() <= other.upper.array()).all() &&
           (other.lower.array() <= upper.array()).all();
  }
};

// The smallest box that holds the posed body, to a few ulp of its sizes and position. A half-space
// is unbounded but on the side of a normal that lies along an axis of the world.
Aabb aabb(const Cylinder& shape, const Pose& pose);
Aabb aabb(const Plane& shape, const Pose& pose);
Aabb aabb(const Sphere& shape, const Pose& pose);
Aabb aabb(const Capsule& shape, const Pose& pose);
Aabb aabb(const Box& shape, const Pose& pose);
Aabb aabb(const Convex& shape, const Pose& pose);
Aabb aabb(const Shape& shape, const Pose& pose);

}  // namespace touchstone
