#include "reports/stability/stability_page.hpp"

#include <string_view>

#include "reports/html/marks.hpp"
#include "reports/html/placeholder.hpp"

namespace touchstone {

// Made by the build from the file of the same name.
extern const std::string_view stability_html;

std::string stability_page(const nlohmann::json& stability) {
  nlohmann::json data = stability;
  data["marks"] = marks(stability["candidates"]);
  std::string page(stability_html);
  fill(page, "/* report.css */", report_css);
  fill(page, "/* elements.js */", elements_js);
  fill(page, "/* stability.js */", stability_js);
  fill(page, "/* stability.json */", script_safe(data));
  return page;
}

}  // namespace touchstone
