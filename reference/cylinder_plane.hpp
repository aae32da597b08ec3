#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

/// Contact of a cylinder with a half-space, in closed form; exact to rounding for every pose.
///
/// Points as in the thesis that this project grew out of: one for a tilted cylinder, two for a
/// lying one (the ends of the touching generator), three at 120° for a standing one, the deepest
/// first. A point is made where the surface itself is no further than `contact_threshold` (metres)
/// from the plane; a cylinder counts as lying or standing when rounding cannot tell it from one.
/// Lengths in metres, world frame; the normal points from B to A. Signed distance and normal are
/// always set, points where the signed distance is at most `contact_threshold`. Accuracy: a few ulp
/// of the lengths and positions.
Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold);

}  // namespace touchstone
