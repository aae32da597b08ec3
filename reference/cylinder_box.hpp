#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// A cylinder against a box: exact for every pose (largest error 1e-13 of the larger size, held by
// accuracy_test.cpp). Lengths in metres, world frame, normals from B to A.

/// Signed distance and normal, however far apart.
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                               const Pose& pose_b);

/// The same with a bound of its error: tries every kind of normal, whatever proves itself on the
/// way.
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                                     const Pose& pose_b);

/// Do they share a point?
bool overlaps(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b);

/// Signed distance, normal and points where the distance is at most `contact_threshold`; returns at
/// once, without points, when a direction proves it larger. One point, two where a side lies on a
/// face or an edge on the cap, three to eight where a cap lies on a face. Where normals tie the
/// first in a fixed order is taken, or, given `previous_normal`, the one nearest to it of those
/// within the threshold.
Contact contact(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr);

}  // namespace touchstone
