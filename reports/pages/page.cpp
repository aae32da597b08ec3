#include "reports/pages/page.hpp"

#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace touchstone {

// Made by the build from the files of the same names.
extern const std::string_view page_html, pages_css, page_js;
extern const std::string_view report_html, compare_html, replay_html, choose_html;
extern const std::string_view report_js, report_tables_js, report_charts_js, report_cases_js;
extern const std::string_view compare_js, replay_js, stability_js, choose_js;
extern const std::string_view bodies_js, view_js, chart_js;
extern const std::string_view vega_js, three_js;

namespace {

/// What a page adds to the shell. Scripts of a page with charts need Vega as their library.
struct PageParts {
  std::string_view title, heading, main;
  std::vector<std::string_view> scripts;
  std::string_view library;
};

PageParts parts_of(Page page) {
  switch (page) {
    case Page::report:
      return {"cylinder contacts",
              "How right, and how fast, are cylinder contacts?",
              report_html,
              {bodies_js, view_js, stability_js, report_js, chart_js, report_tables_js,
               report_charts_js, report_cases_js},
              vega_js};
    case Page::comparison:
      return {"two reports compared", "What has changed?", compare_html, {compare_js}, {}};
    case Page::replay:
      return {"one configuration", "", replay_html, {bodies_js, view_js, replay_js}, {}};
    case Page::stability:
      return {"stability of cylinder contacts",
              "How steady are cylinder contacts near degenerate poses?",
              "<section id=\"stability\"></section>",
              {stability_js, "drawStabilityPage();\n"},
              {}};
    case Page::choice:
      return {"what a scene needs", "", choose_html, {choose_js}, three_js};
  }
  return {};
}

/// Replaces the first `placeholder` of `page`; it must be there.
void fill(std::string& page, std::string_view placeholder, std::string_view text) {
  page.replace(page.find(placeholder), placeholder.size(), text);
}

/// JSON for a script element, which no string of it can end: "<" only occurs in strings, where
/// \u003c says the same.
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

std::string render_page(Page page, const nlohmann::json& data) {
  const PageParts parts = parts_of(page);
  std::string scripts(page_js);
  for (const std::string_view script : parts.scripts) scripts += script;
  std::string text(page_html);
  fill(text, "/* title */", parts.title);
  fill(text, "/* pages.css */", pages_css);
  fill(text, "/* heading */", parts.heading);
  fill(text, "/* main */", parts.main);
  fill(text, "/* library */", parts.library);
  fill(text, "/* scripts */", scripts);
  // Last, so that nothing in it is taken for a placeholder.
  fill(text, "/* data */", script_safe(data));
  return text;
}

}  // namespace touchstone
