#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "simulation/scenes/shapes_file.hpp"

namespace touchstone {

/// What contacts between the shapes of a robot or world must get right.
struct PairNeeds {
  double depth = 1e-3;  ///< metres that an answer may be too shallow or too deep, or miss
  double angle = 5;     ///< degrees that a normal may be off
  std::uint64_t count = 200, seed = 1;  ///< sampled poses of each pair
};

/// Every cylinder of the file against everything that it can touch: shapes of other links without a
/// joint between them, not both of them fixed. Pairs of the same shapes and sizes count once. Poses
/// near contact are sampled (any orientation, any two features, up to a twentieth of the smaller
/// size or four times the depth needed), all candidates are scored on them against the oracle and
/// timed; the cheapest one with all errors below the needs serves. Throws InvalidInput when no
/// cylinder can touch anything.
nlohmann::json choose_for_pairs(const ShapesFile& file, const PairNeeds& needs,
                                const std::vector<const Candidate*>& candidates,
                                const Limits& limits, const std::string& command,
                                const std::string& folder);

/// A file for each failure that choose_for_pairs names, for `touchstone replay`.
void write_pair_evidence(const nlohmann::json& choice);

/// For a terminal of 80 columns.
std::string pairs_text(const nlohmann::json& choice);

}  // namespace touchstone
