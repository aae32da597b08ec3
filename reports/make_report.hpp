#pragma once

#include <string>

#include "reports/campaign.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// Runs the campaign and the timing. `command` is the command line that a person would repeat. When
/// an end is asked for (interruption.hpp) the report is of what was done by then, and says so
/// (`partial`).
Report make_report(const Campaign& campaign, const std::string& command);

/// The machine that this runs on.
Machine describe_machine();

}  // namespace touchstone
