#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/identity.hpp"
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

/// An exactly degenerate pose from the thesis, and two changes of A's pose that break the
/// degeneracy.
struct CriticalPose {
  std::string name;         ///< "standing"
  std::string description;  ///< one sentence
  Configuration configuration;
  /// A rotation (radians about A's centre) and a translation (in smaller sizes), per unit of the
  /// zoom.
  struct Change {
    std::string what;  ///< "tilt about x"
    Vec3 turn, move;
  };
  Change across, up;  ///< along the map's columns and rows
};

/// The nine poses, in report order.
const std::vector<CriticalPose>& critical_poses();
/// Throws InvalidInput that lists the existing names.
const CriticalPose& find_critical_pose(std::string_view name);

/// One pixel of a pose's map. Column and row run from -map_reach to map_reach, where the change is
/// that of the zoom; 0, 0 is the degenerate pose.
inline constexpr int map_reach = 16;
Configuration map_pixel(const CriticalPose& pose, Decade zoom, int column, int row);

/// A slow continuous motion of A through a degenerate pose, which is one of its steps if their
/// number is even.
struct Motion {
  std::string name;         ///< "roll-over-edge"
  std::string description;  ///< one sentence
  /// The configuration at a time from -1 to 1; a rational function, so that it has the same bits on
  /// every machine.
  std::function<Configuration(double time)> at;
};

/// All motions, in report order.
const std::vector<Motion>& motions();
/// Throws InvalidInput that lists the existing names.
const Motion& find_motion(std::string_view name);

/// The pose after `step` of `steps` equal steps of time. Precondition: 0 <= step <= steps, 0 <
/// steps.
Configuration pose_at(const Motion& motion, int step, int steps);

// Besides identities, these names determine a configuration bit for bit:
//   map/standing/1e-12/-3/16          a pixel: pose, zoom, column, row
//   sequence/roll-over-edge/113/200   a step of a motion: its number of how many

/// The configuration of such a name; none if the text does not begin like one. Throws InvalidInput
/// that names the wrong part.
std::optional<Subject> named_configuration(const std::string& text);

/// The name of a perturbed configuration: "cylinder-box/parallel-side/1/4@1e-8/1/4".
std::string perturbed_name(const std::string& base, const Perturbation& perturbation);

}  // namespace touchstone
