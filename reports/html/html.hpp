#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {

/// One self-contained page of a report (docs/report-schema.md): its data and script are inside,
/// nothing is loaded from elsewhere. Strings of the report cannot break out of the page.
std::string render_html(const nlohmann::json& report);

}  // namespace touchstone
