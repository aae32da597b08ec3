#pragma once

#include <string>
#include <vector>

#include "properties/motions/perturbation.hpp"

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

}  // namespace touchstone
