#pragma once

#include "reference/configuration.hpp"

namespace touchstone {

/// Signed distance of a point from a posed body's surface, metres, negative inside; in double, to a
/// few ulp of the coordinates. Ericson, "Real-Time Collision Detection", 2004, ch. 5.
double point_distance(const Shape& shape, const Pose& pose, const Vec3& point);

}  // namespace touchstone
