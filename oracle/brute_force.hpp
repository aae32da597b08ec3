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
BruteForce brute_force_maximum(const Configuration& configuration, int directions);

}  // namespace touchstone::oracle
