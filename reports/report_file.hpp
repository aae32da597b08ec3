#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "reports/report.hpp"

namespace touchstone {

/// Reads the rows of a report.json, whom they are about, and what a comparison must know of the
/// run: version, seed, bar, machine, candidates' versions, whether it is partial. Trends, worst
/// cases and the other parts are left out. Throws InvalidInput that names the file, the field, and
/// what to do.
Report read_report(const std::filesystem::path& file);
/// Reads the text of such a file; `name` is what errors call it.
Report report_from_text(std::string_view text, const std::string& name);

/// Writes report.json (report_json.hpp) and report.html into the folder, each as a whole or not at
/// all. Throws InvalidInput (field "--out") where that cannot be done.
void write_report(const Report& report, const std::filesystem::path& folder);

}  // namespace touchstone
