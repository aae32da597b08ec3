#pragma once

#include <vector>

#include "reference/configuration.hpp"

namespace touchstone {

/// A configuration as numbers that may be changed one by one.
struct Numbers {
  Pair pair = Pair::plane;
  std::vector<double> sizes;  ///< all > 0: radius and half length of A, then B's
  Vec3 position_a = Vec3::Zero(), position_b = Vec3::Zero();
  Eigen::Quaterniond orientation_a{1, 0, 0, 0}, orientation_b{1, 0, 0, 0};
  Vec3 normal = Vec3::Zero();  ///< of a plane
  double displacement = 0;     ///< of a plane
};

/// How many lengths both shapes have; a plane has none.
std::size_t size_count(Pair pair);

Numbers numbers_of(const Configuration& configuration);
/// Throws InvalidInput where a shape or a pose would.
Configuration configuration_of(const Numbers& numbers);

/// Where the numbers are: those of A, then those of B, each as shape, position, orientation (w, x,
/// y, z). Valid as long as `numbers` is, and its number of sizes stays.
std::vector<double*> every_number(Numbers& numbers);

}  // namespace touchstone
