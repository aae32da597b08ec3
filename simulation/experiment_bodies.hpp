#pragma once

#include <cmath>
#include <numbers>

#include "simulation/scene.hpp"

// What the experiments' scenes are made of.
namespace touchstone {

inline constexpr double gravity = 9.81;     ///< m/s², along -z
inline constexpr double can_radius = 0.25;  ///< m
inline constexpr double can_half_length = 0.5;
inline constexpr double steel = 7800;  ///< kg/m³

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

inline Eigen::Quaterniond about(const Vec3& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

/// Turns the local z, a cylinder's axis, to the world's x.
inline Eigen::Quaterniond along_x() { return about(Vec3::UnitY(), std::numbers::pi / 2); }

inline Body fixed_body(const char* name, const Shape& shape, double friction,
                       const Pose& pose = {}) {
  return {name, shape, steel, {friction, 0}, pose, Vec3::Zero(), Vec3::Zero(), true};
}
inline Body moving_body(const char* name, const Shape& shape, double friction, const Pose& pose) {
  return {name, shape, steel, {friction, 0}, pose};
}
inline Body ground(double friction) {
  return fixed_body("ground", Plane(Vec3::UnitZ(), 0), friction);
}

/// Metres. Bodies upon one another begin in the middle of the surface layer, so that what the
/// solver leaves of their weights in a step opens no contact; on this overlap nothing depends.
inline double middle_of_layer(const Scene& scene) { return scene.surface_layer / 2; }

/// The can's radius of gyration, metres, about a level line across its axis that passes the axis at
/// one distance and the centre, along the axis, at the other.
inline double can_gyration(double from_axis, double from_middle) {
  return std::sqrt(can_radius * can_radius / 4 + can_half_length * can_half_length / 3 +
                   from_axis * from_axis + from_middle * from_middle);
}

}  // namespace touchstone
