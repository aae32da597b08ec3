#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "reports/report.hpp"

namespace touchstone {

// The format of report.json (docs/report.schema.json). What was not measured is null.

/// Version of the format: member "schema".
inline constexpr int report_schema = 3;

nlohmann::json to_json(const Report& report);

/// JSON text of an object with a line for each member and for each entry of its lists: half the
/// size of indented text, and a changed row is one changed line.
std::string text_by_lines(const nlohmann::json& object);

// Parts of it that stand in other formats too:

nlohmann::json to_json(const Machine& machine);
nlohmann::json to_json(const PoseClassDescription& pose_class);
/// The member `summary`.
nlohmann::json summary_json(const Report& report);
/// An entry of `results`.
nlohmann::json to_json(const ResultRow& row);
/// {"id", "configuration", "truth", "answers", "replay"}; without a truth, neither that nor
/// answers.
nlohmann::json to_json(const Examination& examination);
nlohmann::json to_json(const History& history);
nlohmann::json to_json(const WorstCase& worst);
nlohmann::json to_json(const Factor& factor);
nlohmann::json to_json(const Contrast& contrast);

/// Reads the rows of a report.json, whom they are about, and what a comparison must know of the
/// run: version, seed, bar, machine, candidates' versions, whether it is partial. Trends, worst
/// cases and the other parts are left out. Throws InvalidInput that names the file, the field, and
/// what to do.
Report read_report(const std::filesystem::path& file);
/// Reads the text of such a file; `name` is what errors call it.
Report report_from_text(std::string_view text, const std::string& name);

/// Writes report.json and report.html into the folder, each as a whole or not at all. Throws
/// InvalidInput (field "--out") where that cannot be done.
void write_report(const Report& report, const std::filesystem::path& folder);

// Its pages (report_page.cpp):

/// report.html: one self-contained page; nothing is loaded from elsewhere.
std::string report_page(const Report& report);

/// Some of the experiments in motion, the most striking, without and with our contacts; runs them
/// again (engine_motions.cpp).
nlohmann::json engine_motions(const EngineResults& results);

/// One self-contained page of the part `engines`: what our contacts change in the engines, with
/// these motions. `command` is the command line that a person would repeat.
std::string engines_page(const EngineResults& results, const std::string& command,
                         const nlohmann::json& motions);

}  // namespace touchstone
