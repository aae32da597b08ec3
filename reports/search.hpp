#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "properties/laws/check.hpp"
#include "reports/campaign.hpp"

namespace touchstone {

/// Where to look for one candidate's worst configuration of a class, and how long.
struct Search {
  Cell cell;
  std::uint64_t seed = 1;
  std::uint64_t budget = 1000;  ///< configurations that are asked
  Bar bar;
};

/// The worst configuration found; scores compare as in worst_of_class.
struct SearchResult {
  Configuration configuration;
  Score score;
  std::string identity;  ///< of the sampled configuration that it grew from
  Score sampled;         ///< the worst of the sampled ones
};

/// Samples a quarter of the budget, then changes the worst of these little by little as long as the
/// score gets worse: hill climbing over the random numbers that made them, so that all stay in
/// their class. Half of the rest is divided equally among the four worst, what remains goes to the
/// worst of the results. The same seed gives the same result. Stops at the first crash, timeout,
/// failure or non-finite answer. `progress` is told how many configurations were asked.
SearchResult search(CandidateProcess& candidate, const Search& search,
                    const std::function<void(std::uint64_t)>& progress);

/// The failure that `check` would report, of the law "answers", "agreement" or "points"; absent
/// where the candidate agrees.
std::optional<Failure> failure_of(const SearchResult& found, CandidateProcess& candidate,
                                  const Bar& bar);

/// {"pair", "class", "outcome", "depth_error", "normal_regret", "severity", "sampled_severity",
/// "from", "configuration"}, the latter in hexadecimal floats.
nlohmann::json to_json(const SearchResult& found, const Cell& cell);

}  // namespace touchstone
