#include "reports/compare_page/compare_page.hpp"

#include <string>
#include <vector>

#include "reference/invalid_input.hpp"
#include "reports/html/marks.hpp"
#include "reports/html/placeholder.hpp"

namespace touchstone {

// Made by the build from the files of the same names.
extern const std::string_view compare_html, compare_css, compare_js;

std::string compare_page(const nlohmann::json& comparison, const nlohmann::json& before,
                         const nlohmann::json& after) {
  std::vector<std::string> names;
  for (const auto* summary : {&before["summary"], &after["summary"]}) {
    for (const auto& row : *summary) names.push_back(row["candidate"]);
  }
  std::string page(compare_html);
  fill(page, "/* report.css */", report_css);
  fill(page, "/* compare.css */", compare_css);
  fill(page, "/* elements.js */", elements_js);
  fill(page, "/* compare.js */", compare_js);
  fill(page, "/* comparison.json */",
       script_safe({{"comparison", comparison},
                    {"before", before["summary"]},
                    {"after", after["summary"]},
                    {"marks", marks(names)}}));
  return page;
}

}  // namespace touchstone
