#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// A cylinder against a capsule. The largest gap over all normals lies at one of five kinds, four of
// them closed forms (cylinder_capsule.cpp). Lengths in metres, positions and normals in the world
// frame; a normal is a unit vector that points from B to A.

/// Returns the signed distance and its normal, however far apart the bodies are; zero where they
/// touch. Where normals tie, the first in a fixed order. Within 1e-13 of the larger size of the
/// truth, for every pose (accuracy_test.cpp). Some 40 to 70 ns.
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Capsule& b,
                               const Pose& pose_b);

/// Returns the same with a bound of its error, which is rounding (certified_test.cpp): tries every
/// kind of normal, whatever proves itself on the way.
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Capsule& b,
                                     const Pose& pose_b);

/// Returns whether the bodies share a point; those that touch do, as far as rounding can tell.
bool overlaps(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b);

/// Returns signed distance, normal and points where the distance is at most `contact_threshold`;
/// else no points, as soon as a direction proves it larger, and the clearance along that. One
/// point, or two where the capsule lies along the side or across a cap; the deepest has the whole
/// depth (point_contract_test.cpp). Where normals tie, the first in a fixed order is taken, or,
/// given `previous_normal`, the nearest to it of those within the threshold. Some 40 ns apart, 90
/// overlapping.
Contact contact(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);

}  // namespace touchstone
