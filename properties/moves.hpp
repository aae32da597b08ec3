#pragma once

#include "reference/configuration.hpp"

namespace touchstone {

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
