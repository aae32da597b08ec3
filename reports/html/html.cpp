#include "reports/html/html.hpp"

#include <string_view>

#include "reports/html/placeholder.hpp"

namespace touchstone {

// Made by the build from the files of the same names.
extern const std::string_view report_html;
extern const std::string_view report_js;

std::string render_html(const nlohmann::json& report) {
  std::string page(report_html);
  fill(page, "/* report.css */", report_css);
  fill(page, "/* elements.js */", elements_js);
  fill(page, "/* stability.js */", stability_js);
  fill(page, "/* report.js */", report_js);
  fill(page, "/* report.json */", script_safe(report));
  return page;
}

}  // namespace touchstone
