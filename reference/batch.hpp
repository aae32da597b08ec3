#pragma once

#include <span>

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// The questions of cylinder_plane.hpp and its siblings for many poses of one pair of shapes, as a
// broad phase finds them: poses_a[i] and poses_b[i] make the i-th pair, and results[i] is its
// answer, the same to the last bit as that of the function for one pair. `Other` is Plane, Sphere,
// Capsule, Cylinder or Box.
//
// Nothing is allocated. All spans must have one length, which may be zero: else InvalidInput is
// thrown and nothing written. Results must not overlap the poses.
//
// What that saves: where several pairs at once tell cheaply which bodies are apart by more than
// asked for, `overlaps` and `contact` answer those and ask the function for one pair about the
// others; spheres are answered so altogether. The signed distance of a capsule, cylinder or box has
// nothing to leave out, and takes the same time as one by one. README.md has the figures.

template <class Other>
void signed_distance(const Cylinder& a, std::span<const Pose> poses_a, const Other& b,
                     std::span<const Pose> poses_b, std::span<SignedDistance> results);

template <class Other>
void overlaps(const Cylinder& a, std::span<const Pose> poses_a, const Other& b,
              std::span<const Pose> poses_b, std::span<bool> results);

template <class Other>
void contact(const Cylinder& a, std::span<const Pose> poses_a, const Other& b,
             std::span<const Pose> poses_b, double contact_threshold, std::span<Contact> results,
             PointRange range = PointRange::near_deepest);

// Of planes they stand in cylinder_plane.cpp.
template <>
void signed_distance(const Cylinder& a, std::span<const Pose> poses_a, const Plane& b,
                     std::span<const Pose> poses_b, std::span<SignedDistance> results);
template <>
void overlaps(const Cylinder& a, std::span<const Pose> poses_a, const Plane& b,
              std::span<const Pose> poses_b, std::span<bool> results);
template <>
void contact(const Cylinder& a, std::span<const Pose> poses_a, const Plane& b,
             std::span<const Pose> poses_b, double contact_threshold, std::span<Contact> results,
             PointRange range);

}  // namespace touchstone
