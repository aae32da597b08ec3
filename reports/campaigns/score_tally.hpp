#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "reports/campaigns/magnitudes.hpp"
#include "reports/statistics.hpp"
#include "reports/worst_selection.hpp"

namespace touchstone {

/// The scores of one candidate on any number of configurations, in constant memory. Everything in
/// it is an integer, a maximum or a selection under a total order: tallies of the parts, added in
/// any order, are the tally of the whole to the last bit.
class ScoreTally {
 public:
  void add(std::size_t cell, std::uint64_t index, const Score& score);
  void add(const ScoreTally& other);

  std::uint64_t count() const { return count_; }
  /// Of a tally of one class: its worst_of_class.
  const std::vector<Case>& worst() const { return worst_; }

  Statistics statistics() const;

  nlohmann::json to_json() const;
  /// Of a tally whose cases are all of this cell. Throws InvalidInput on anything else than to_json
  /// gives.
  static ScoreTally from_json(const nlohmann::json& json, std::size_t cell);

 private:
  void select_worst();

  /// Errors of a score, as report.json calls them; less is better.
  struct Quantity {
    const char* name;
    std::optional<double> Score::*value;
    std::optional<Quantiles> Statistics::*quantiles;
  };
  static constexpr std::array<Quantity, 7> quantities = {
      {{"depth_error", &Score::depth_error, &Statistics::depth_error},
       {"normal_regret", &Score::normal_regret, &Statistics::normal_regret},
       {"normal_angle", &Score::normal_angle, &Statistics::normal_angle},
       {"point_error", &Score::point_error, &Statistics::point_error},
       {"deepest_error", &Score::deepest_error, &Statistics::deepest_error},
       {"model_error", &Score::model_error, &Statistics::model_error},
       {"solver_error", &Score::solver_error, &Statistics::solver_error}}};

  std::uint64_t count_ = 0;
  std::array<std::uint64_t, all_outcomes.size()> outcomes_{};
  std::map<int, std::uint64_t> points_;
  std::array<Magnitudes, quantities.size()> errors_;
  Magnitudes severity_;            ///< Of all that is judged, missed contacts included.
  Magnitudes uncovered_;           ///< One minus coverage.
  std::uint64_t covered_sum_ = 0;  ///< Of coverage, in units of 2^-24.
  std::vector<Case> worst_;
};

}  // namespace touchstone
