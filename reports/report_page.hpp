#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "reports/report.hpp"

namespace touchstone {

/// report.html: one self-contained page; nothing is loaded from elsewhere.
std::string report_page(const Report& report);

/// A report with its long lists, such as `results`, at a fifth of the size: as {schema, rows} with
/// their numbers to four digits, and the `strings` that rows name by number. A schema is "string",
/// null (as it is) or an object, whose values a row gives in its order.
nlohmann::json packed(const nlohmann::json& report);

/// One self-contained page of the part `engines`: what our contacts change in the engines, and some
/// of the experiments in motion, without and with them; runs these again. `command` is the command
/// line that a person would repeat.
std::string engines_page(const EngineResults& results, const std::string& command);

}  // namespace touchstone
