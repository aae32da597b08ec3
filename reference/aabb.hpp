#pragma once

#include "pose.hpp"
#include "shape.hpp"

namespace touchstone {

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
Aabb aabb(const Shape& shape, const Pose& pose);

}  // namespace touchstone
