#pragma once

#include <optional>
#include <string_view>

#include "reference/configuration.hpp"

namespace touchstone {

/// How two bodies lie to each other, in the words of the pose classes.
struct NearestArrangement {
  /// Tilts below about 3e-15 rad are the rounding of unit quaternions.
  static constexpr int exact = 15;

  std::string_view name;  ///< of an arrangement of the pair
  /// k of the power 10^-k rad next to the angle by which the bodies are tilted out of it; `exact`
  /// up to rounding. Absent where the arrangement has no such angle: "rim-face", "general".
  std::optional<int> tilt;

  bool operator==(const NearestArrangement&) const = default;
};

/// The arrangement that the bodies are within 0.1 rad of, told from the angles between their axes
/// (or faces) and the normal; otherwise the one whose features meet: "rim-face".
///
/// Where two arrangements are one to the solver, the more common word is used: a cylinder along a
/// box's face is "side-on-face", however its axis lies to the box's edges, and what touches has the
/// name of its features. "rim-side" and "rim-face" do not tell whose rim it is. "parallel" and
/// "perpendicular" are left for rims and edges that meet while the axes, or the axis and the edge,
/// are within 0.01 rad of being so. Overlapping centres ("coaxial", "concentric") are told like any
/// other overlap.
NearestArrangement nearest_arrangement(const Configuration& configuration);

}  // namespace touchstone
