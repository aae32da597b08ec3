#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>
#include <string>

#include "reference/configuration.hpp"

namespace touchstone {

// What tests share that try many configurations: how many, at random, and in what unit of error.

/// TOUCHSTONE_COUNT, if it is set.
inline std::uint64_t tried_of_each(std::uint64_t by_default) {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : by_default;
}

/// Of each pose class of a pair: hulls have six times as many classes.
inline std::uint64_t of_each_class(Pair pair, std::uint64_t of_others) {
  return pair == Pair::convex ? (of_others + 4) / 5 : of_others;
}

/// Names a test after the shape that meets the cylinder.
inline std::string name_of_other(const testing::TestParamInfo<Pair>& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
}

/// The larger size. A plane may be far from its own origin; its offset then counts as a size.
inline double size_of(const Configuration& c) {
  const auto* plane = std::get_if<Plane>(&c.b);
  return std::max(larger_size(c), plane ? std::abs(plane->unit_displacement()) : 0);
}
/// What rounding is relative to: the larger size, or how far the bodies are apart.
inline double scale_of(const Configuration& c) {
  return std::max(size_of(c), (c.pose_a.position() - c.pose_b.position()).stableNorm());
}

/// What errors of distances and normals are at most, in parts of such a length.
inline constexpr double promised = 1e-13;

/// Numbers, directions and turns; each seed has its own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed) {}

  double uniform(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random_); }
  double power_of_ten(double lo, double hi) { return std::pow(10, uniform(lo, hi)); }
  int one_of(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }
  bool toss() { return one_of(2) == 0; }
  double sign() { return toss() ? 1 : -1; }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    const double x = normal(random_), y = normal(random_);
    return Vec3(x, y, normal(random_)).normalized();
  }
  Eigen::Quaterniond turn() {
    const double z = uniform(-1, 1), y = uniform(-1, 1), x = uniform(-1, 1);
    return Eigen::Quaterniond(uniform(-1, 1), x, y, z).normalized();
  }

 private:
  std::mt19937_64 random_;
};

/// Those whose shapes are given by sizes alone, which a hull is not.
inline constexpr Pair pairs_of_sizes[] = {Pair::plane, Pair::sphere, Pair::capsule, Pair::cylinder,
                                          Pair::box};

/// A shape of one of these that meets the cylinder; `size` and `plane` are asked for what it needs.
template <class Size, class MakePlane>
Shape shape_of_sizes(Pair pair, Size size, MakePlane plane) {
  if (pair == Pair::plane) return plane();
  const double x = size();
  if (pair == Pair::sphere) return Sphere(x);
  const double y = size();
  if (pair == Pair::capsule) return Capsule(x, y);
  if (pair == Pair::cylinder) return Cylinder(x, y);
  return Box(Vec3(x, y, size()));
}

}  // namespace touchstone
