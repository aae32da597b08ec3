#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reference/configuration.hpp"

namespace touchstone {

/// A power of ten from 1e-16 to 1e-1, known by its exponent, so that its name and its double are
/// one.
class Decade {
 public:
  static constexpr int least = -16, most = -1;
  /// Precondition: least <= exponent <= most.
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
  /// By its remainder by three: a translation by amplitude × smaller size in a random direction, a
  /// rotation by amplitude radians (to second order in it) about a random axis through A's centre,
  /// or both.
  std::uint64_t number;
};
std::string to_string(const Perturbation& perturbation);
/// Reads what to_string wrote. Throws InvalidInput.
Perturbation parse_perturbation(std::string_view text);

/// The configuration with A so moved, in doubles: the same bits everywhere. Steps near the doubles'
/// own spacing come out as the nearest pose there is, maybe the same one.
Configuration perturbed(const Configuration& configuration, const Perturbation& perturbation);

/// A turned about its centre by the rotation vector (radians, small), then moved.
Configuration moved(const Configuration& configuration, const Vec3& turn, const Vec3& by);

/// A length that no point of body A moves beyond between the two poses, metres: how far its centre
/// moves and, for the angle θ between the orientations, 2 sin(θ/2) times its circumradius. The
/// signed distance of convex bodies changes by no more than that (their supports do not).
double largest_displacement(const Configuration& from, const Configuration& to);

}  // namespace touchstone
