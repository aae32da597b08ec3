#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/laws/check.hpp"
#include "reports/campaign.hpp"

namespace touchstone {

/// Where to look for one candidate's worst configuration of a class, and how long.
struct Search {
  Cell cell;
  std::uint64_t seed = 1;
  std::uint64_t budget = 1000;  ///< Configurations that are asked.
  Bar bar;
};

/// What was found; the scores of two configurations compare as in worst_of_class.
struct Found {
  Configuration configuration;
  Score score;
  std::string identity;  ///< Of the sampled configuration that it grew from.
  Score sampled;         ///< The worst of the sampled ones.
};

/// A quarter of the budget is sampled; the worst of these are then changed little by little, as
/// long as the score gets worse: hill climbing over the random numbers that made them, so that all
/// stay in their class. Half of what is left goes to the four worst alike, the rest to the worst of
/// what became of them. The same seed finds the same. Ends early where there is no answer at all,
/// than which nothing is worse. `progress` is told how many were asked.
Found search(CandidateProcess& candidate, const Search& search,
             const std::function<void(std::uint64_t)>& progress);

/// As `check` would have met it, of the law "answers" or "agreement"; absent where the candidate
/// agrees.
std::optional<Failure> failure_of(const Found& found, CandidateProcess& candidate, const Bar& bar);

/// {"pair", "class", "outcome", "depth_error", "normal_regret", "severity", "sampled_severity",
/// "from", "configuration"}, the latter in hexadecimal floats.
nlohmann::json to_json(const Found& found, const Cell& cell);

}  // namespace touchstone
