#pragma once

#include "candidates/candidate.h"
#include "reference/configuration.hpp"

namespace touchstone {

/// Signed distance of a point from a posed body's surface, metres, negative inside; in double, to a
/// few ulp of the coordinates. Ericson, "Real-Time Collision Detection", 2004, ch. 5.
double point_distance(const Shape& shape, const Pose& pose, const Vec3& point);

/// By how much a contact point is farther from the surface of either body than its own depth,
/// metres; not positive for a point that may stand for the contact: between the surfaces or on one.
double point_excess(const Configuration& configuration, const ts_point& point);

}  // namespace touchstone
