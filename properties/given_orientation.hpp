#pragma once

#include <Eigen/Geometry>

#include "reference/shape.hpp"

namespace touchstone {

// An orientation as people have it who have no quaternion. What is returned has no unit length: its
// largest component lies between 1 and 2, because quarter and half turns are then exact.

/// The orientation nearest to a matrix that maps the body's frame to the world's. Throws
/// InvalidInput (field "rotation") unless it is a rotation to 1e-9.
Eigen::Quaterniond orientation_of(const Eigen::Matrix3d& rotation);

/// The shortest turn that carries the body's z, the axis of a cylinder, to this direction of the
/// world, of any length. Throws InvalidInput (field "axis") where it is zero.
Eigen::Quaterniond orientation_along(const Vec3& axis);

}  // namespace touchstone
