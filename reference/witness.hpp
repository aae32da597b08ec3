#pragma once

#include "configuration.hpp"

namespace touchstone {

/// The points of two bodies that face each other across an optimal normal: a on A's support feature
/// towards −n, b on B's towards n, with a − b = σ n. Where the features overlap in more than a
/// point (parallel sides, a cap on a face), a pair near the middle of B's feature.
struct Witness {
  Vec3 on_a, on_b;
};

/// `normal` must be optimal to about 1e-8 rad for the two points to lie opposite each other. B is a
/// capsule, cylinder or box.
Witness witness(const Cylinder& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                const Vec3& normal, double signed_distance);

}  // namespace touchstone
