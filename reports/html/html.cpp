#include "reports/html/html.hpp"

#include <string_view>

namespace touchstone {

// Made by the build from the files of the same names.
extern const std::string_view report_html;
extern const std::string_view report_css;
extern const std::string_view report_js;

namespace {

void replace_once(std::string& text, std::string_view placeholder, std::string_view replacement) {
  text.replace(text.find(placeholder), placeholder.size(), replacement);
}

/// JSON within a script element: "<" only occurs in strings, where \u003c says the same.
std::string script_safe(const nlohmann::json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string render_html(const nlohmann::json& report) {
  std::string page(report_html);
  replace_once(page, "/* report.css */", report_css);
  replace_once(page, "/* report.js */", report_js);
  // Last, so that nothing in the data is taken for a placeholder.
  replace_once(page, "/* report.json */", script_safe(report));
  return page;
}

}  // namespace touchstone
