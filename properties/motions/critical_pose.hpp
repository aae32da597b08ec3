#pragma once

#include <string>
#include <vector>

#include "properties/motions/perturbation.hpp"

namespace touchstone {

/// One of the thesis's critical poses, exactly degenerate, and two changes of A's pose that break
/// the degeneracy.
struct CriticalPose {
  std::string name;         ///< "standing"
  std::string description;  ///< one sentence
  Configuration configuration;
  /// A turn (radians about A's centre) and a move (smaller sizes), for one unit of the zoom.
  struct Change {
    std::string what;  ///< "tilt about x"
    Vec3 turn, move;
  };
  Change across, up;  ///< along the map's columns and rows
};

/// The nine, in report order.
const std::vector<CriticalPose>& critical_poses();
/// Throws InvalidInput that names those there are.
const CriticalPose& find_critical_pose(std::string_view name);

/// One pixel of a pose's map: column and row run from -map_reach to map_reach, where the change is
/// by the zoom, and are zero in the degenerate pose itself.
inline constexpr int map_reach = 16;
Configuration map_pixel(const CriticalPose& pose, Decade zoom, int column, int row);

}  // namespace touchstone
