#pragma once

#include <optional>
#include <string>

#include "reports/report.hpp"

namespace touchstone {

/// A member of a report.json that cannot be right beside the others.
struct Inconsistency {
  std::string place;  ///< "results[3].count"
  std::string value;  ///< as in the file
  std::string remedy;
};

/// The first contradiction within a report that was read, if there is one: a candidate or a row
/// twice (of which only one would be compared), a row of no candidate, candidates that answered
/// different numbers of configurations, or a sum that is another one.
std::optional<Inconsistency> inconsistency(const Report& report);

}  // namespace touchstone
