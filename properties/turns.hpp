#pragma once

#include <Eigen/Geometry>

#include "reference/shape.hpp"

namespace touchstone {

// Orientations that align a body exactly: integer quaternions, whose rotation matrices are exact
// although their length is not one (Pose normalises). x, y and z are the world's axes.

inline const Eigen::Quaterniond upright(1, 0, 0, 0);
inline const Eigen::Quaterniond along_x(1, 0, 1, 0);   ///< local z along x, local x along -z
inline const Eigen::Quaterniond along_y(1, -1, 0, 0);  ///< local z along y, local y along -z

/// Rotation by an angle (radians, counter-clockwise) about an axis of unit length.
inline Eigen::Quaterniond about(const Vec3& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

}  // namespace touchstone
