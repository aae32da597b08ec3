#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reference/configuration.hpp"

namespace touchstone {

/// A power of ten from 1e-16 to 1e-1, stored as its exponent, so that its name and its double
/// agree.
class Decade {
 public:
  static constexpr int min = -16, max = -1;
  /// Precondition: min <= exponent <= max.
  explicit Decade(int exponent) : exponent_(exponent) {}
  /// Reads "1e-8"; throws InvalidInput that names the field.
  static Decade parse(const char* field, std::string_view text);

  double value() const;
  int exponent() const { return exponent_; }
  std::string name() const { return "1e" + std::to_string(exponent_); }
  bool operator==(const Decade&) const = default;

 private:
  int exponent_;
};

/// A small change of body A's pose: "1e-8/1/4", amplitude, seed and number.
struct Perturbation {
  Decade amplitude;
  std::uint64_t seed;
  /// The remainder by three selects a translation by amplitude × smaller size in a random direction
  /// (0), a rotation by amplitude radians (to second order) about a random axis through A's centre
  /// (1), or both (2).
  std::uint64_t number;
};
std::string to_string(const Perturbation& perturbation);
/// Reads what to_string wrote. Throws InvalidInput.
Perturbation parse_perturbation(std::string_view text);

/// The configuration with A so moved: the same bits on every machine. A step near the spacing of
/// doubles is rounded, possibly to no step at all.
Configuration perturbed(const Configuration& configuration, const Perturbation& perturbation);

/// Rotates A about its centre by a small rotation vector (radians), then translates it.
Configuration moved(const Configuration& configuration, const Vec3& turn, const Vec3& by);

/// Upper bound of the distance by which any point of A moves between the two poses, metres: the
/// distance of its centres plus, for the angle θ between the orientations, 2 sin(θ/2) times its
/// circumradius. It also bounds the change of its support, and so that of the signed distance.
double largest_displacement(const Configuration& from, const Configuration& to);

}  // namespace touchstone
