#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// A cylinder against a half-space, in closed form: the deepest point is on the lower cap's rim.
// Lengths in metres, positions and normals in the world frame; a normal is a unit vector that
// points from B to A, and here always the plane's.

/// Returns the signed distance and its normal, however far apart the bodies are; zero where they
/// touch. Accurate to a few ulp of the lengths and positions, for every pose (accuracy_test.cpp).
/// Some 6 ns.
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                               const Pose& pose_b);

/// Returns the same with a bound of its error, which is rounding (certified_test.cpp).
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                                     const Pose& pose_b);

/// Returns whether the bodies share a point; those that touch do, as far as rounding can tell.
bool overlaps(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b);

/// Returns signed distance, normal and points where the distance is at most `contact_threshold`;
/// else no points. One point for a tilted cylinder; two for a lying one, the ends of the touching
/// generator; three at 120° for a standing one, more while it leans by a hair (disc_layout.hpp).
/// The deepest has the whole depth (point_contract_test.cpp). There is one normal, so
/// `previous_normal` changes nothing. Some 12 ns.
Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);

}  // namespace touchstone
