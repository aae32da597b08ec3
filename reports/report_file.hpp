#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace touchstone {

/// Reads a report.json and checks everything of it that `compare` uses. Throws InvalidInput that
/// names the file, the field, and what to do.
nlohmann::json read_report(const std::filesystem::path& file);
/// The same of its text; `name` is what errors call the file.
nlohmann::json report_from_text(std::string_view text, const std::string& name);

}  // namespace touchstone
