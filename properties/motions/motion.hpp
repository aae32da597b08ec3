#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/identity.hpp"
#include "properties/motions/perturbation.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

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

std::string pixel_name(const CriticalPose& pose, Decade zoom, int column, int row);
std::string step_name(const Motion& motion, int step, int steps);

/// The configuration of such a name; none if the text does not begin like one. Throws InvalidInput
/// that names the wrong part.
std::optional<Subject> named_configuration(const std::string& text);

/// The name of a perturbed configuration: "cylinder-box/parallel-side/1/4@1e-8/1/4".
std::string perturbed_name(const std::string& base, const Perturbation& perturbation);

}  // namespace touchstone
