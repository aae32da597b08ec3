#pragma once

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>

#include <nlohmann/json.hpp>

namespace touchstone {

// Numbers as charts and tables need them, so that a report stays small; null where nothing was
// measured.

/// Two significant digits; what is below the rounding of doubles is zero.
inline nlohmann::json short_number(const std::optional<double>& value) {
  if (!value) return nullptr;
  if (*value < 1e-15) return 0;
  return std::strtod(fmt::format("{:.2g}", *value).c_str(), nullptr);
}

/// A ratio to a bound, to two decimals upwards: it shows 1 only when it is at most 1 + 1e-9.
inline nlohmann::json rounded_up(const std::optional<double>& value) {
  if (!value) return nullptr;
  if (*value >= 10) return short_number(value);
  return std::ceil(100 * *value * (1 - 1e-9)) / 100;
}

}  // namespace touchstone
