#pragma once

#include <string>

#include "reports/report.hpp"

namespace touchstone {

/// The summary of a report for a terminal of 80 columns: a row for each pair and candidate, the
/// worst failure of each candidate with the command that replays it.
std::string terminal_table(const Report& report);

}  // namespace touchstone
