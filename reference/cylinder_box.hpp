#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// A cylinder against a box. The largest gap over all normals lies at one of six kinds, all but one
// of them closed forms (cylinder_box.cpp). Lengths in metres, positions and normals in the world
// frame; a normal is a unit vector that points from B to A.

/// Returns the signed distance and its normal, however far apart the bodies are; zero where they
/// touch. Where normals tie, the first in a fixed order. Within 1e-13 of the larger size of the
/// truth, for every pose (accuracy_test.cpp). Some 70 to 250 ns.
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                               const Pose& pose_b);

/// Returns the same with a bound of its error, which is rounding (certified_test.cpp): tries every
/// kind of normal, whatever proves itself on the way.
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                                     const Pose& pose_b);

/// Returns whether the bodies share a point; those that touch do, as far as rounding can tell.
bool overlaps(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b);

/// Returns signed distance, normal and points where the distance is at most `contact_threshold`;
/// else no points, as soon as a direction proves it larger, and the clearance along that. One
/// point; two where a side lies on a face or an edge on the cap; three to eight where a cap lies on
/// a face; the deepest has the whole depth (point_contract_test.cpp). Where normals tie, the first
/// in a fixed order is taken, or, given `previous_normal`, the nearest to it of those within the
/// threshold. Some 70 ns apart, 150 to 300 overlapping.
Contact contact(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);

}  // namespace touchstone
