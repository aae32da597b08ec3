#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "reports/campaign.hpp"

namespace touchstone {

/// Runs the campaign and the timing and assembles report.json (docs/report-schema.md). `command` is
/// the command line that a person would repeat. When an end is asked for (interruption.hpp) the
/// report is of what was done by then, and says so ("partial").
nlohmann::json make_report(const Campaign& campaign, const std::string& command);

/// Writes report.json and report.html into the folder, each as a whole or not at all. Throws
/// InvalidInput (field "--out") where that cannot be done.
void write_report(const nlohmann::json& report, const std::filesystem::path& folder);

}  // namespace touchstone
