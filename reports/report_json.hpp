#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "reports/report.hpp"

namespace touchstone {

// The format of report.json (docs/report-schema.md). What was not measured is null.

/// Version of the format: member "schema".
inline constexpr int report_schema = 2;

nlohmann::json to_json(const Report& report);

/// JSON text of an object with a line for each member and for each entry of its lists: half the
/// size of indented text, and a changed row is one changed line.
std::string text_by_lines(const nlohmann::json& object);

// Parts of it that stand in other formats too:

nlohmann::json to_json(const Machine& machine);
nlohmann::json to_json(const PoseClassDescription& pose_class);
/// An entry of `results`.
nlohmann::json to_json(const ResultRow& row);
/// {"id", "configuration", "truth", "answers", "replay"}; without a truth, neither that nor
/// answers.
nlohmann::json to_json(const Examination& examination);
nlohmann::json to_json(const WorstCase& worst);
nlohmann::json to_json(const Factor& factor);
nlohmann::json to_json(const Contrast& contrast);

}  // namespace touchstone
