#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// A cylinder against a half-space, in closed form: accurate to a few ulp of the lengths and
// positions for every pose (accuracy_test.cpp). Lengths in metres, world frame; the normal is the
// plane's.

/// Signed distance and normal, however far apart.
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                               const Pose& pose_b);

/// The same with a bound of its error.
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                                     const Pose& pose_b);

/// Do they share a point?
bool overlaps(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b);

/// Signed distance, normal and points where the distance is at most `contact_threshold`: one for a
/// tilted cylinder, two for a lying one (the ends of the touching generator), three at 120° for a
/// standing one, the deepest first. There is one normal, so `previous_normal` changes nothing.
Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr);

}  // namespace touchstone
