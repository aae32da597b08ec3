#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// A cylinder against a sphere, in closed form: the nearest point of the cylinder to the sphere's
// centre, or, with the centre inside, the nearest of side and caps. Accurate to a few ulp of the
// lengths and positions (accuracy_test.cpp). Lengths in metres, world frame, normals from B to A.

/// Signed distance and normal, however far apart. A centre on the axis or as near to a cap as to
/// the side has several optimal normals: the cap's wins, and off the axis local x.
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                               const Pose& pose_b);

/// The same with a bound of its error.
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                                     const Pose& pose_b);

/// Do they share a point?
bool overlaps(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b);

/// Signed distance, normal and one point where the distance is at most `contact_threshold`. Given
/// `previous_normal`, of normals within the threshold the nearest to it is taken.
Contact contact(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr);

}  // namespace touchstone
