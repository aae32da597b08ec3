#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "properties/numbers.hpp"
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

/// A configuration near contact that one of the shipped scenes produced with exact contacts: a line
/// of recorded.jsonl (docs/scenes.md says how they are sampled).
struct Recorded {
  std::string_view scene;
  std::uint64_t weight;  ///< number of narrow-phase questions that it stands for
  Configuration configuration;
};

/// Those of a pair, in the order of the file.
const std::vector<Recorded>& recorded(Pair pair);

/// How often an arrangement occurs among a pair's recorded questions.
struct RecordedShare {
  Pair pair;
  NearestArrangement arrangement;
  double share;  ///< of the pair's questions
};

/// By pair, then from the most frequent to the rarest arrangement and tilt.
std::vector<RecordedShare> recorded_shares();

/// Configurations that some contact routine once answered wrongly, ours or an engine's (those of
/// known_failures.jsonl). None for a plane.
const std::vector<Numbers>& known_failures(Pair pair);

}  // namespace touchstone
