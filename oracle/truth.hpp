#pragma once

#include <gmpxx.h>
#include <vector>

#include "oracle/enclosure.hpp"
#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// How many directions reach the signed distance, as far as the enclosure can tell them apart.
enum class Ties { unique, finite, continuum };

/// What is true of one configuration.
struct Truth {
  Enclosure signed_distance;  ///< Metres; positive apart, negative inside.
  /// Unit vectors from B to A that reach the signed distance, in double, without duplicates. Of a
  /// continuum only the critical ones that were met: at least one.
  std::vector<Vec3> normals;
  Ties ties;
};

/// Signed distance and optimal normals by exact critical directions (see oracle/README.md). The
/// enclosure is no wider than `width` times the larger size. Never guesses: throws
/// std::logic_error if its own bounds contradict each other.
Truth truth(const Configuration& configuration, double width = 1e-15);

/// Enclosure of the clearance g(n/|n|) of the exact configuration along a vector n of doubles,
/// finite and not zero, no wider than `width` times the larger size. A half-space has no finite
/// gap except along its own normal, and no engine can answer that to the last bit: for a plane, g
/// is taken against the column of the half-space beneath the cylinder's circumsphere, two
/// circumradii deep, so that a tilted answer costs what it is worth to this cylinder.
Enclosure certified_gap(const Configuration& configuration, const Vec3& n, double width = 1e-15);

/// Normal regret σ − g(n) >= 0 in metres, to within `width` times the larger size, rounded to a
/// double not below zero.
double normal_regret(const Configuration& configuration, const Truth& truth, const Vec3& n);

}  // namespace touchstone::oracle
