#include "reports/pages/page.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace touchstone {

// Made by the build from the files of the same names.
extern const std::string_view page_html, pages_css, page_js, table_js;
extern const std::string_view report_html, compare_html, replay_html, choose_html, engines_html;
extern const std::string_view report_js, report_tables_js, report_charts_js, report_cases_js;
extern const std::string_view compare_js, replay_js, stability_js, choose_js, engines_js, motion_js;
extern const std::string_view bodies_js, view_js, chart_js, vega_js;

namespace {

/// What a page adds to the shell.
struct PageParts {
  std::string_view title, heading, main;
  bool charts;  ///< needs Vega
  std::vector<std::string_view> scripts;
};

PageParts parts_of(Page page) {
  switch (page) {
    case Page::report:
      return {"cylinder contacts",
              "How right, and how fast, are cylinder contacts?",
              report_html,
              true,
              {bodies_js, view_js, stability_js, engines_js, report_js, report_tables_js,
               report_charts_js, report_cases_js}};
    case Page::comparison:
      return {"two reports compared", "What has changed?", compare_html, true, {compare_js}};
    case Page::replay:
      return {"one configuration", "", replay_html, false, {bodies_js, view_js, replay_js}};
    case Page::stability:
      return {"stability of cylinder contacts",
              "How steady are cylinder contacts near degenerate poses?",
              "<section id=\"stability\"></section>",
              true,
              {stability_js, "drawStabilityPage();\n"}};
    case Page::choice:
      return {
          "what a scene needs", "", choose_html, true, {bodies_js, view_js, motion_js, choose_js}};
    case Page::engines:
      return {"inside the engines",
              "What do exact contacts change inside the engines?",
              engines_html,
              false,
              {bodies_js, view_js, motion_js, engines_js, "drawEnginesPage();\n"}};
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
  scripts += table_js;
  if (parts.charts) scripts += chart_js;
  for (const std::string_view script : parts.scripts) scripts += script;
  std::string text(page_html);
  fill(text, "/* title */", parts.title);
  fill(text, "/* pages.css */", pages_css);
  fill(text, "/* heading */", parts.heading);
  fill(text, "/* main */", parts.main);
  fill(text, "/* vega.js */", parts.charts ? vega_js : std::string_view());
  fill(text, "/* scripts */", scripts);
  // Last, so that nothing in it is taken for a placeholder.
  fill(text, "/* data */", script_safe(data));
  return text;
}

Mark mark_of(std::string_view candidate) {
  constexpr std::size_t symbols = 6;
  static const std::vector<std::vector<std::string_view>> engines = {
      {"reference"},
      {"bullet", "bullet-margin-0", "bullet-persistent", "bullet-hull", "bullet-float",
       "bullet-float-margin-0"},
      {"ode", "ode-mesh"},
      {"fcl", "fcl-indep", "fcl-distance"},
      {"libccd-gjk", "libccd-mpr"},
      {"mujoco"},
      {"capsule", "capsule-circumscribed", "spheres", "prism", "box-spheres", "box-capsules"}};
  const std::string_view family = candidate.substr(0, candidate.find(':'));
  for (std::size_t i = 0; i < engines.size(); ++i) {
    const auto at = std::find(engines[i].begin(), engines[i].end(), family);
    if (at != engines[i].end()) return {i, static_cast<std::size_t>(at - engines[i].begin())};
  }
  const auto sum = std::accumulate(
      candidate.begin(), candidate.end(), std::size_t{0},
      [](std::size_t total, char c) { return total + static_cast<unsigned char>(c); });
  return {engines.size(), sum % symbols};
}

std::map<std::string, std::array<std::size_t, 2>> marks(
    const std::vector<std::string>& candidates) {
  std::map<std::string, std::array<std::size_t, 2>> result;
  for (const auto& name : candidates) {
    const Mark mark = mark_of(name);
    result[name] = {mark.colour, mark.symbol};
  }
  return result;
}

}  // namespace touchstone
