#pragma once

#include <vector>

#include "reference/configuration.hpp"

namespace touchstone {

/// A configuration as plain numbers that can be changed one by one.
struct Numbers {
  Pair pair = Pair::plane;
  std::vector<double> sizes;        ///< all > 0: radius and half length of A, then B's
  std::vector<Vec3> vertices = {};  ///< of a convex body, whose hull is made anew
  double rounding_a = 0, rounding_b = 0;
  Vec3 position_a = Vec3::Zero(), position_b = Vec3::Zero();
  Eigen::Quaterniond orientation_a{1, 0, 0, 0}, orientation_b{1, 0, 0, 0};
  Vec3 normal = Vec3::Zero();  ///< of a plane
  double displacement = 0;     ///< of a plane
};

/// Number of lengths of both shapes; a plane and a hull have none.
std::size_t size_count(Pair pair);

Numbers numbers_of(const Configuration& configuration);
/// Throws InvalidInput if a shape's or a pose's constructor does.
Configuration configuration_of(const Numbers& numbers);

/// Addresses of all numbers but roundings of zero: A's, then B's, each as shape, position,
/// orientation (w, x, y, z). Valid while `numbers` exists and its number of sizes is unchanged.
std::vector<double*> every_number(Numbers& numbers);

/// Rotates both bodies about the world's origin by a quaternion of moderate length.
void turn_both(Numbers& numbers, const Eigen::Quaterniond& by);
/// Multiplies all lengths by 2^exponent.
void scale_both(Numbers& numbers, int exponent);

}  // namespace touchstone
