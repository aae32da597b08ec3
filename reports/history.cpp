#include "reports/history.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>

#include <nlohmann/json.hpp>

#include "properties/identity.hpp"
#include "reports/compare.hpp"
#include "reports/pages/page.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/row_text.hpp"

namespace touchstone {
namespace {

constexpr double min_step = 0.05;  ///< of agreement: less may be a rounding of another compiler

template <class T>
std::vector<T> only(const std::vector<T>& all, std::string T::*member,
                    const std::map<std::string, std::string>& new_names) {
  std::vector<T> result;
  for (const T& each : all) {
    const auto name = new_names.find(each.*member);
    if (name == new_names.end()) continue;
    result.push_back(each);
    result.back().*member = name->second;
  }
  return result;
}

/// Over all pairs, or of the only one.
const ResultRow* everyday_row(const Report& report, const std::string& candidate) {
  const ResultRow* found = nullptr;
  for (const ResultRow& row : report.summary) {
    const bool is = row.candidate == candidate && row.pose_class == "everyday" &&
                    row.statistics.supported() > 0;
    if (is && (!found || row.pair == "all")) found = &row;
  }
  return found;
}

bool has_mended(const ReleaseStep& step) { return step.after > step.before; }

/// "broke 3, mended 1"
std::string counts_text(const std::vector<ReleaseStep>& steps, const std::string& candidate) {
  std::string text;
  for (const bool mended : {false, true}) {
    const auto count = std::ranges::count_if(steps, [&](const ReleaseStep& step) {
      return step.candidate == candidate && has_mended(step) == mended;
    });
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", mended ? "mended" : "broke", count);
  }
  return text.empty() ? "-" : text;
}

/// "rapier@0.14 mended general: 70.0% -> 100.0%", with how many more of the pair.
std::string step_text(const ReleaseStep& step, std::size_t more) {
  return fmt::format("  {} {} {}: {:.1f}% -> {:.1f}%{}", step.candidate,
                     has_mended(step) ? "mended" : "broke", step.pose_class, 100 * step.before,
                     100 * step.after, more > 0 ? fmt::format(", and {} more", more) : "");
}

}  // namespace

std::vector<std::string> releases_of(const Report& report, const std::string& engine) {
  std::vector<std::string> names;
  for (const CandidateDescription& c : report.candidates) {
    if (c.name.starts_with(engine + '@')) names.push_back(c.name);
  }
  return names;
}

Report part_of(const Report& report, const std::map<std::string, std::string>& new_names) {
  Report part;
  part.version = report.version;
  part.seed = report.seed;
  part.tolerance = report.tolerance;
  part.threshold = report.threshold;
  part.machine = report.machine;
  part.configurations = report.configurations;
  part.partial = report.partial;
  part.classes = report.classes;
  part.candidates = only(report.candidates, &CandidateDescription::name, new_names);
  part.results = only(report.results, &ResultRow::candidate, new_names);
  part.summary = only(report.summary, &ResultRow::candidate, new_names);
  return part;
}

std::vector<ReleaseStep> release_steps(const Report& report, const std::string& engine) {
  const std::vector<std::string> releases = releases_of(report, engine);
  std::vector<ReleaseStep> steps;
  for (std::size_t i = 1; i < releases.size(); ++i) {
    const Comparison comparison = compare(part_of(report, {{releases[i - 1], engine}}),
                                          part_of(report, {{releases[i], engine}}), {});
    std::vector<ReleaseStep> of_release;
    for (const Change& c : comparison.changes) {
      if (c.measure != "agreement" || std::abs(c.after - c.before) < min_step) continue;
      of_release.push_back({c.pair, c.pose_class, releases[i], c.before, c.after});
    }
    std::ranges::stable_sort(of_release, [](const ReleaseStep& a, const ReleaseStep& b) {
      if (a.pair != b.pair) return a.pair < b.pair;
      return std::abs(a.after - a.before) > std::abs(b.after - b.before);
    });
    std::ranges::move(of_release, std::back_inserter(steps));
  }
  return steps;
}

std::string history_text(const Report& report, const Terminal& terminal) {
  const std::vector<std::string> releases = releases_of(report, report.history->engine);
  const std::vector<ReleaseStep>& steps = report.history->steps;
  std::size_t width = std::string_view("release").size();
  for (const std::string& name : releases) width = std::max(width, name.size());
  std::string text =
      terminal.heading(fmt::format("{:<{}} everyday      ns  classes", "release", width)) + '\n';
  for (const std::string& name : releases) {
    const ResultRow* const row = everyday_row(report, name);
    text += fmt::format("{:<{}} {:>8} {:>7}  {}\n", name, width,
                        row ? agreement_text(row->statistics) : "-", row ? median_time(*row) : "-",
                        counts_text(steps, name));
  }
  text += '\n' + terminal.folded(fmt::format(
                     "everyday: % of these poses answered right; ns: median time of a query; "
                     "classes: of which {:.0f}% more than in the release before are answered "
                     "wrong (broke) or right (mended). First of each pair:",
                     100 * min_step));
  for (const Pair pair : all_pairs) {
    std::string of_pair;
    for (const bool mended : {false, true}) {
      const auto is = [&](const ReleaseStep& step) {
        return step.pair == pair_name(pair) && has_mended(step) == mended;
      };
      const auto first = std::ranges::find_if(steps, is);
      if (first == steps.end()) continue;
      const auto count = static_cast<std::size_t>(std::ranges::count_if(steps, is));
      of_pair += terminal.folded(step_text(*first, count - 1));
    }
    if (!of_pair.empty()) text += '\n' + terminal.heading(pair_name(pair)) + '\n' + of_pair;
  }
  return text;
}

std::string history_page(const Report& report) {
  std::map<std::string, std::string> runs;
  for (const CandidateDescription& c : report.candidates) runs[c.name] = c.runs;
  nlohmann::json data = {{"command", report.command},
                         {"version", report.version},
                         {"releases", releases_of(report, report.history->engine)},
                         {"summary", summary_json(report)},
                         {"history", to_json(*report.history)}};
  for (const CandidateDescription& c : report.candidates) data["versions"][c.name] = c.version;
  return render_page(Page::history, with_candidates(std::move(data), runs));
}

}  // namespace touchstone
