#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {

/// From where on a change is a regression.
struct CompareLimits {
  double error_factor = 2;   ///< by which an error may grow
  double time_factor = 1.5;  ///< by which a time, as a multiple of the baseline's, may grow
  double agreement = 1;      ///< share of the old agreement that must be kept
  std::string baseline = "bullet";
};

/// Errors below this, of the smaller size, are rounding: they count as this one.
inline constexpr double negligible_error = 1e-14;

/// What is better, worse, faster or slower in `after` than in `before`, both as read_report gives
/// them (docs/compare.md). Reports on the same configurations are compared class by class; on
/// others pair by pair, and only beyond chance. Times are compared as multiples of the baseline's;
/// they have changed when even the nearest ends of their spreads are farther apart than the limit.
/// Throws InvalidInput when there is nothing in common.
nlohmann::json compare(const nlohmann::json& before, const nlohmann::json& after,
                       const CompareLimits& limits);

/// For a terminal of 80 columns.
std::string comparison_text(const nlohmann::json& comparison);

bool has_regressed(const nlohmann::json& comparison);

}  // namespace touchstone
