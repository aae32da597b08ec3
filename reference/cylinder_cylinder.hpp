#pragma once

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

/// Contact of two cylinders: signed distance and normal for every pose, one contact point at the
/// deepest place (within 1e-8 of the larger size; 1e-5 where the axes are within 1e-4 rad). Lengths
/// in metres, world frame; the normal points from B to A. Signed distance and normal are always
/// set, points where the signed distance is at most `contact_threshold`. Accuracy: 1e-9 of the
/// larger size, held by accuracy_test.cpp; known to reach 1.6e-9 where rims nearly touch on nearly
/// parallel axes.
Contact contact(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b,
                double contact_threshold);

}  // namespace touchstone
