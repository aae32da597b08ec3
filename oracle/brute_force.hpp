#pragma once

#include "oracle/truth.hpp"
#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// The largest gap found over `directions` directions spread evenly over the sphere, refined by a
/// local search with a shrinking step from the best few. In double precision and without geometry,
/// for tests only: apart from rounding it can only be too small.
struct BruteForce {
  double gap;
  Vec3 normal;
};
/// Precondition: B is not a plane.
BruteForce brute_force_maximum(const Configuration& configuration, int directions);

/// Height over the plane of the lowest of many points around both rims, refined.
double lowest_point_over_plane(const Configuration& configuration);

/// Expects (as a test) that no direction in double has a larger gap than σ, and that the reported
/// normals reach σ.
void expect_brute_force_agrees(const Configuration& configuration, const Truth& truth,
                               int directions = 1000);

}  // namespace touchstone::oracle
