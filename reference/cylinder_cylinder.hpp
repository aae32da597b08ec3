#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// Two cylinders. The largest gap over all normals lies at one of four kinds: closed forms, a point
// against an ellipse, and rims that meet, which are scanned (cylinder_cylinder.cpp, proofs.md).
// Lengths in metres, positions and normals in the world frame; a normal is a unit vector that
// points from B to A. Exchanged bodies have the same distance and points and the opposite normal,
// bit for bit.

/// Returns the signed distance and its normal, however far apart the bodies are; zero where they
/// touch. Where normals tie, the first in a fixed order. Within 1e-13 of the larger size of the
/// truth, for every pose (accuracy_test.cpp). Some 50 to 500 ns, most where rims meet.
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                               const Pose& pose_b);

/// Returns the same with a bound of its error: tries every kind of normal and searches all rims,
/// whatever proves itself on the way (proofs.md). The bound is rounding where that is proven
/// complete, else larger (certified_test.cpp). Some 2 µs.
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                                     const Pose& pose_b);

/// Returns whether the bodies share a point; those that touch do, as far as rounding can tell.
bool overlaps(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b);

/// Returns signed distance, normal and points where the distance is at most `contact_threshold`;
/// else no points, as soon as a direction proves it larger, and the clearance along that. One
/// point; two where sides are parallel or a side lies across a cap; three for a cap within a cap;
/// four for caps that overlap in part; the deepest has the whole depth (point_contract_test.cpp).
/// Where normals tie, the first in a fixed order is taken, or, given `previous_normal`, the nearest
/// to it of those within the threshold. Some 60 ns apart, 150 to 500 overlapping.
Contact contact(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);

}  // namespace touchstone
