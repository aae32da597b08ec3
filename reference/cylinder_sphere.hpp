#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// A cylinder against a sphere, in closed form: the nearest point of the cylinder to the sphere's
// centre, or, with the centre inside, the nearest of side and caps. Lengths in metres, positions
// and normals in the world frame; a normal is a unit vector that points from B to A.

/// Returns the signed distance and its normal, however far apart the bodies are; zero where they
/// touch. A centre on the axis, or as near to a cap as to the side, has several optimal normals:
/// the cap's is taken, and off the axis local x. Accurate to a few ulp of the lengths and positions
/// (accuracy_test.cpp). Some 9 ns.
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                               const Pose& pose_b);

/// Returns the same with a bound of its error, which is rounding (certified_test.cpp).
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                                     const Pose& pose_b);

/// Returns whether the bodies share a point; those that touch do, as far as rounding can tell.
bool overlaps(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b);

/// Returns signed distance, normal and one point where the distance is at most `contact_threshold`;
/// else no point, and a clearance that is above the threshold and not above the distance. Given
/// `previous_normal`, of normals whose gaps are within the threshold of the largest the one nearest
/// to it is taken. Some 10 ns.
Contact contact(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);

}  // namespace touchstone
