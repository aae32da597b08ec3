#pragma once

#include "reference/configuration.hpp"

namespace touchstone {

// Changes of a configuration that laws speak of. Fixed, so that a law asks the same of the same
// configuration everywhere; rounding is a few ulp of the coordinates.

Configuration exchanged(const Configuration& cylinders);
Configuration rotated(const Configuration& c, const Eigen::Quaterniond& turn);
Configuration translated(const Configuration& c, const Vec3& by);
Configuration with_a_moved(const Configuration& c, const Vec3& by);
/// Every body about its own axis of revolution; a box not at all.
Configuration spun(const Configuration& c, double angle);
/// Every body by half a turn about its own x axis; a plane not at all.
Configuration flipped(const Configuration& c);
/// All lengths times a factor.
Configuration scaled(const Configuration& c, double factor);
/// Body A's radius and half length times two factors.
Configuration with_a_grown(const Configuration& c, double radius, double half_length);

}  // namespace touchstone
