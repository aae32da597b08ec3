#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

/// Contact of a cylinder with a sphere, in closed form: the nearest point of the cylinder to the
/// sphere's centre (or, with the centre inside, the nearest face). One point. A centre on the axis
/// or at equal distance from a cap and the side has several optimal normals; one is chosen by a
/// fixed rule. Lengths in metres, world frame; the normal points from B to A. Signed distance and
/// normal are always set, points where the signed distance is at most `contact_threshold`.
/// Accuracy: a few ulp of the lengths and positions.
Contact contact(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                double contact_threshold);

}  // namespace touchstone
