#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reports/campaign.hpp"
#include "reports/campaigns/magnitudes.hpp"
#include "reports/campaigns/units.hpp"

namespace touchstone {

/// Everything that decides what a campaign's result is, as its files say it: version, command,
/// seed, count, bar, limits, classes, candidates with the checksums of their plug-ins, and a
/// checksum of the first configuration of each class, which changes when a generator does. Parts
/// with the same plan belong together. `command` gives the same result in one process; it names
/// every setting.
nlohmann::json make_plan(const Campaign& campaign, const std::string& command);

/// What a file needs to know of its plan. Throws InvalidInput on anything else than make_plan
/// gives.
struct PlanView {
  /// Of each class; numbers of units and configurations of all classes do not overflow.
  static constexpr std::uint64_t max_count = Magnitudes::max_count;

  explicit PlanView(const nlohmann::json& plan);

  std::vector<Cell> cells;
  std::vector<std::string> candidates;
  Cut cut;
  std::uint64_t seed;
};

/// Throws InvalidInput (field `file`) naming what differs and how, unless both plans are the same.
void require_same_plan(const nlohmann::json& expected, const nlohmann::json& found,
                       const std::string& file);

}  // namespace touchstone
