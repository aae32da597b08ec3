#pragma once

#include <cstddef>
#include <span>

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// The questions of contact.hpp for many poses of one pair of shapes, as a broad phase finds them:
// poses_a[i] and poses_b[i] make the i-th pair, and results[i] is its answer, the same to the last
// bit as that of the function for one pair.
//
// Nothing is allocated. All spans must have the same length, which may be zero: else InvalidInput
// is thrown and nothing written. Results must not overlap the poses.
//
// What that saves: several pairs at once are asked whether they are apart by more than was asked
// for, along the normals by which that mostly shows: cylinders and boxes that are apart, by
// `overlaps` and `contact`. The rest takes about the same time as one by one. README.md has the
// figures.

void signed_distance(const Cylinder& a, std::span<const Pose> poses_a, const Shape& b,
                     std::span<const Pose> poses_b, std::span<SignedDistance> results);

void overlaps(const Cylinder& a, std::span<const Pose> poses_a, const Shape& b,
              std::span<const Pose> poses_b, std::span<bool> results);

/// Without a hint of previous normals: pairs that have one touch already, and are not looked at in
/// passing.
void contact(const Cylinder& a, std::span<const Pose> poses_a, const Shape& b,
             std::span<const Pose> poses_b, double contact_threshold, std::span<Contact> results,
             PointRange range = PointRange::near_deepest);

/// Throws InvalidInput unless a batch has as many poses of B and results as poses of A.
void check_lengths(std::size_t poses_a, std::size_t poses_b, std::size_t results);

}  // namespace touchstone
