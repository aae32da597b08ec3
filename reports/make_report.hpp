#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "reports/campaign.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// Runs the campaign and the timing. `command` is the command line that a person would repeat. When
/// an end is asked for (interruption.hpp) the report is of what was done by then, and says so
/// (`partial`).
Report make_report(const Campaign& campaign, const std::string& command);

/// Writes report.json, as of report_json.hpp, and report.html into the folder, each as a whole or
/// not at all. Throws InvalidInput (field "--out") where that cannot be done.
void write_report(const nlohmann::json& report, const std::filesystem::path& folder);

}  // namespace touchstone
