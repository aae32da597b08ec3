#include "reports/pages/page.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <vector>
#include <zlib.h>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/configuration_json.hpp"
#include "simulation/scene.hpp"

namespace touchstone {

// Made by the build from the files of the same names.
extern const std::string_view page_html, pages_css, page_js, table_js;
extern const std::string_view report_html, compare_html, replay_html, choose_html, engines_html,
    motion_html, history_html;
extern const std::string_view report_js, report_failures_js, report_tables_js, report_charts_js,
    report_method_js, casts_js;
extern const std::string_view compare_js, replay_js, stability_js, choose_js, engines_js, motion_js,
    history_js;
extern const std::string_view bodies_js, view_js, sweep_js, chart_js, vega_js;

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
              {bodies_js, view_js, sweep_js, stability_js, engines_js, report_js,
               report_failures_js, report_tables_js, report_charts_js, casts_js, report_method_js}};
    case Page::comparison:
      return {"two reports compared", "What has changed?", compare_html, true, {compare_js}};
    case Page::replay:
      return {
          "one configuration", "", replay_html, false, {bodies_js, view_js, sweep_js, replay_js}};
    case Page::stability:
      return {"stability of cylinder contacts",
              "How steady are cylinder contacts near degenerate poses?",
              "<section id=\"stability\"><h2>Stability</h2></section>",
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
    case Page::history:
      return {"releases of an engine",
              "What did each release change?",
              history_html,
              true,
              {history_js}};
  }
  return {};
}

/// Replaces the first `placeholder` of `page`; it must be there.
void fill(std::string& page, std::string_view placeholder, std::string_view text) {
  page.replace(page.find(placeholder), placeholder.size(), text);
}

/// Text as the page unpacks it.
std::string compressed(std::string_view text) {
  uLongf size = compressBound(text.size());
  std::vector<Bytef> bytes(size);
  compress(bytes.data(), &size, reinterpret_cast<const Bytef*>(text.data()), text.size());
  return base64(std::span(bytes).first(size));
}

}  // namespace

std::string render_page(Page page, const nlohmann::json& data) {
  constexpr std::string_view motion_place = "/* motion */";  // of pages that play motions
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
  if (parts.main.find(motion_place) != parts.main.npos) fill(text, motion_place, motion_html);
  fill(text, "/* vega.js */", compressed(parts.charts ? vega_js : std::string_view()));
  fill(text, "/* scripts */", scripts);
  // What is not seen in a string becomes text that is, as on a terminal.
  const std::string dumped = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  fill(text, "/* data */", compressed(escaped(dumped, Printed::lines, "\\\\")));
  return text;
}

Mark mark_of(std::string_view candidate) {
  constexpr std::size_t symbols = 6, other = 7;
  struct Engine {
    std::size_t colour, first_symbol;
    std::vector<std::string_view> settings;
  };
  // The simplified models have colour 6, what is not known here 7, some outcomes 8 to 10. Where two
  // colours are alike, the symbols are not.
  static const std::vector<Engine> engines = {
      {0, 0, {"reference", "reference-float"}},
      {1,
       0,
       {"bullet", "bullet-margin-0", "bullet-persistent", "bullet-hull", "bullet-float",
        "bullet-float-margin-0", "bullet-floor", "bullet-floor-edges", "bullet-heights",
        "bullet-heights-edges"}},
      {2, 0, {"ode", "ode-mesh", "ode-floor", "ode-heights"}},
      {3, 0, {"fcl", "fcl-indep", "fcl-distance", "fcl-floor"}},
      {4, 0, {"libccd-gjk", "libccd-mpr"}},
      {5, 0, {"mujoco", "mujoco-heights"}},
      {6,
       0,
       {"capsule", "capsule-circumscribed", "spheres", "prism", "box-spheres", "box-capsules"}},
      {11, 3, {"jolt", "jolt-margin-0", "jolt-margin", "jolt-world", "jolt-floor"}},
      {12, 2, {"rapier", "rapier-world", "rapier-floor", "rapier-floor-edges"}},
      {13, 1, {"physx", "physx-world", "physx-floor"}},
      {14, 5, {"havok", "havok-floor"}},
      {15, 4, {"mujoco3", "mujoco3-single"}}};
  const std::string_view family = candidate.substr(0, candidate.find_first_of(":@"));
  const auto sum_of = [](std::string_view text) {
    return std::accumulate(text.begin(), text.end(), std::size_t{0}, [](std::size_t total, char c) {
      return total + static_cast<unsigned char>(c);
    });
  };
  for (const auto& [colour, first_symbol, settings] : engines) {
    const auto at = std::find(settings.begin(), settings.end(), family);
    if (at == settings.end()) continue;
    const auto release = std::min(candidate.find('@'), candidate.size());
    return {colour, (first_symbol + static_cast<std::size_t>(at - settings.begin()) +
                     sum_of(candidate.substr(release))) %
                        symbols};
  }
  return {other, sum_of(candidate) % symbols};
}

nlohmann::json faces_json(const Shape& shape) {
  nlohmann::json faces = nlohmann::json::array();
  if (const auto* hull = std::get_if<Convex>(&shape)) {
    for (const Convex::Face& face : hull->faces()) faces.push_back(face.vertices);
  }
  return faces;
}

nlohmann::json bodies_json(const Scene& scene) {
  nlohmann::json bodies = nlohmann::json::array();
  for (const Body& b : scene.bodies) {
    const auto& q = b.pose.orientation();
    nlohmann::json shape = to_json(b.shape);
    if (std::holds_alternative<Convex>(b.shape)) shape["faces"] = faces_json(b.shape);
    bodies.push_back({{"name", b.name},
                      {"shape", std::move(shape)},
                      {"fixed", b.fixed},
                      {"pose",
                       {{"position", to_json(b.pose.position())},
                        {"orientation", {q.w(), q.x(), q.y(), q.z()}}}}});
  }
  return bodies;
}

std::string base64(const std::vector<float>& numbers) {
  return base64(
      {reinterpret_cast<const unsigned char*>(numbers.data()), numbers.size() * sizeof(float)});
}

std::string base64(std::span<const unsigned char> bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

}  // namespace touchstone
