#pragma once

#include <cstdint>
#include <iterator>
#include <rapidcheck/Random.h>
#include <vector>

#include "reference/configuration.hpp"

namespace touchstone {

/// The random numbers that went into one configuration, in the order in which they were drawn.
using Tape = std::vector<std::uint64_t>;

/// Numbers and directions from one of rapidcheck's random streams. Only + − × ÷ and square roots
/// are used, each rounded once as IEEE 754 says (no contraction, no libm), so that a stream gives
/// the same bits on every machine.
class Draw {
 public:
  explicit Draw(const rc::Random& random) : random_(random) {}
  /// Draws the numbers on the tape; after its end the stream's numbers are appended to it. The tape
  /// must outlive this.
  Draw(const rc::Random& random, Tape& tape) : random_(random), tape_(&tape) {}

  std::int64_t integer(std::int64_t lo, std::int64_t hi);  ///< both ends included
  bool coin() { return integer(0, 1) == 1; }
  bool one_in(std::int64_t count) { return integer(0, count - 1) == 0; }
  /// A random element of a container or array.
  template <class Range>
  auto& any_of(Range& range) {
    return range[static_cast<std::size_t>(
        integer(0, static_cast<std::int64_t>(std::size(range)) - 1))];
  }
  double sign() { return coin() ? 1 : -1; }
  double uniform(double lo, double hi);
  /// Every octave from lo upwards is equally likely; within an octave the distribution is uniform.
  double log_uniform(double lo, double hi);

  Vec3 direction();  ///< unit, uniform on the sphere
  Vec3 direction_across(const Vec3& unit);
  /// Uniform over all orientations (Marsaglia 1972), unit up to rounding.
  Eigen::Quaterniond orientation();
  Eigen::Quaterniond turn_about_z();  ///< by a uniform angle

 private:
  std::uint64_t next();

  rc::Random random_;
  Tape* tape_ = nullptr;
  std::size_t at_ = 0;  ///< on the tape
};

// Eigen's order of additions depends on the instruction set; that of these functions is fixed.
double dot(const Vec3& a, const Vec3& b);
Vec3 cross(const Vec3& a, const Vec3& b);
Vec3 normalized(const Vec3& v);
Eigen::Quaterniond normalized(const Eigen::Quaterniond& q);
/// Hamilton product; exact for small integers.
Eigen::Quaterniond product(const Eigen::Quaterniond& p, const Eigen::Quaterniond& q);
/// R(q) times |q|²: exact for small integers, unit columns for unit quaternions.
struct Axes {
  Vec3 x, y, z;
};
Axes axes(const Eigen::Quaterniond& q);
/// Rotates v by a quaternion of moderate length.
Vec3 rotated(const Eigen::Quaterniond& q, const Vec3& v);

}  // namespace touchstone
