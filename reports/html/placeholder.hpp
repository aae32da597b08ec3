#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace touchstone {

// What all pages share; made by the build from the files of the same names.
extern const std::string_view report_css;
extern const std::string_view elements_js;
extern const std::string_view bodies_js, view_js, scene_js;  ///< a configuration in 3-D
extern const std::string_view stability_js;

/// Puts `text` where `placeholder`, as in "/* report.css */", first stands; it must be there. Data
/// goes in last, so that nothing in it is taken for a placeholder.
void fill(std::string& page, std::string_view placeholder, std::string_view text);

/// JSON for a script element, which no string of it can end.
std::string script_safe(const nlohmann::json& json);

}  // namespace touchstone
