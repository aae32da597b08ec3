#pragma once

#include <string>

#include "reports/report.hpp"

namespace touchstone {

/// The summary of a report for a terminal of 80 columns: a row for each pair and candidate in
/// everyday poses, and for all pairs in those of the other groups; what a candidate passes and
/// fails once turned or tilted; its worst failure. Commands replay both.
std::string terminal_table(const Report& report);

}  // namespace touchstone
