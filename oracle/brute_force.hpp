#pragma once

#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// Largest gap met over `directions` directions spread evenly over the sphere and a shrinking local
/// search from the best few of them. Double precision, no geometry, for tests only: it can only be
/// too small, apart from rounding.
struct BruteForce {
  double gap;
  Vec3 normal;
};
/// B must not be a plane.
BruteForce brute_force_maximum(const Configuration& configuration, int directions);

/// Height over the plane of the lowest of many points around both rims, refined.
double lowest_point_over_plane(const Configuration& configuration);

}  // namespace touchstone::oracle
