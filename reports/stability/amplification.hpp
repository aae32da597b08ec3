#pragma once

#include <cstdint>

#include <nlohmann/json.hpp>

#include "reports/campaign.hpp"
#include "reports/stability/examined_pose.hpp"
#include "reports/worst.hpp"

namespace touchstone {

/// Around which configurations steps are made: `count` of each cell, and at each of the sixteen
/// amplitudes one step from each of them.
struct Ladder {
  std::vector<Cell> cells;
  std::uint64_t seed = 1, count = 6;
};

/// Every class whose degeneracy is exact, of each of these pairs.
std::vector<Cell> degenerate_cells(const std::vector<Pair>& pairs);

/// Member "amplification" of stability.json (docs/stability.md). A step goes from a configuration
/// to perturbed ones; the cells are spread over worker processes.
nlohmann::json amplification(const Ladder& ladder, const Study& study);

/// The same around one configuration: `count` steps at each amplitude.
nlohmann::json amplification(const Subject& base, std::uint64_t seed, std::uint64_t count,
                             const Study& study);

}  // namespace touchstone
