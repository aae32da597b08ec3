#pragma once

#include <Eigen/Geometry>

#include "reference/configuration.hpp"

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

/// Whether a body looks the same however it is turned about its local z axis.
bool is_round(const Shape& shape);

// Changes of a configuration that laws use. They are deterministic; rounding is a few ulp of the
// coordinates.

Configuration exchanged(const Configuration& cylinders);
Configuration rotated(const Configuration& c, const Eigen::Quaterniond& turn);
Configuration translated(const Configuration& c, const Vec3& by);
Configuration with_a_moved(const Configuration& c, const Vec3& by);
/// Rotates every body about its own axis of revolution; a box stays.
Configuration spun(const Configuration& c, double angle);
/// Rotates every body by 180° about its own x axis; a plane stays.
Configuration flipped(const Configuration& c);
/// Multiplies all lengths by a factor.
Shape scaled(const Shape& shape, double factor);
Configuration scaled(const Configuration& c, double factor);
/// Multiplies body A's radius and half length by two factors.
Configuration with_a_grown(const Configuration& c, double radius, double half_length);

}  // namespace touchstone
