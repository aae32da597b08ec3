#include "reports/replay_page/replay_page.hpp"

#include "reference/invalid_input.hpp"
#include "reports/html/marks.hpp"
#include "reports/html/placeholder.hpp"

namespace touchstone {

// Made by the build from the files of the same names.
extern const std::string_view replay_html, replay_css, slice_js, replay_js;

std::string replay_page(nlohmann::json examined, const nlohmann::json& hexadecimal,
                        const nlohmann::json& exact, std::string_view description) {
  examined["hexadecimal"] = hexadecimal;
  examined["exact"] = exact;
  examined["description"] = description;
  std::vector<std::string> names;
  for (const auto& [name, unused] : examined["answers"].items()) names.push_back(name);
  examined["marks"] = marks(names);
  std::string page(replay_html);
  fill(page, "/* report.css */", report_css);
  fill(page, "/* replay.css */", replay_css);
  fill(page, "/* elements.js */", elements_js);
  fill(page, "/* bodies.js */", bodies_js);
  fill(page, "/* view.js */", view_js);
  fill(page, "/* scene.js */", scene_js);
  fill(page, "/* slice.js */", slice_js);
  fill(page, "/* replay.js */", replay_js);
  fill(page, "/* replay.json */", script_safe(examined));
  return page;
}

}  // namespace touchstone
