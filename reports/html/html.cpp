#include "reports/html/html.hpp"

#include <string_view>

#include "reports/html/page_data.hpp"
#include "reports/html/placeholder.hpp"

namespace touchstone {

// Made by the build.
extern const std::string_view report_html;
extern const std::string_view report_js;
extern const std::string_view vega_js;

std::string render_html(const nlohmann::json& report) {
  std::string page(report_html);
  fill(page, "/* report.css */", report_css);
  fill(page, "/* vega.js */", vega_js);
  fill(page, "/* elements.js */", elements_js);
  fill(page, "/* bodies.js */", bodies_js);
  fill(page, "/* view.js */", view_js);
  fill(page, "/* scene.js */", scene_js);
  fill(page, "/* stability.js */", stability_js);
  fill(page, "/* report.js */", report_js);
  fill(page, "/* report.json */", script_safe(page_data(report)));
  return page;
}

}  // namespace touchstone
