#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace touchstone {

/// Of report.json (docs/report-schema.md).
inline constexpr int report_schema = 1;

/// Reads a report.json and checks everything of it that `compare` uses. Throws InvalidInput that
/// names the file, the field, and what to do.
nlohmann::json read_report(const std::filesystem::path& file);

}  // namespace touchstone
