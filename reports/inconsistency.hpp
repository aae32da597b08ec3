#pragma once

#include <optional>

#include "reference/invalid_input.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// The first contradiction within a report that was read, if there is one: a candidate or a row
/// twice (of which only one would be compared), a row of no candidate, candidates that answered
/// different numbers of configurations, or a sum that is another one. Its field is the place in the
/// file ("results[3].count").
std::optional<InvalidInput> inconsistency(const Report& report);

}  // namespace touchstone
