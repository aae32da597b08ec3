#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/given_text.hpp"
#include "properties/files/json_members.hpp"
#include "reports/compare.hpp"
#include "reports/pages/page.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using Verdict = Change::Verdict;

std::string value_text(const Change& change, double value) {
  if (change.measure == "has a routine") return value > 0 ? "yes" : "no";
  if (change.measure.starts_with("agreement")) return fmt::format("{:.1f}%", 100 * value);
  if (change.measure == "time") return fmt::format("{:.2f}", value);
  if (change.measure == "instructions") return fmt::format("{:.0f}", value);
  return value == 0 ? "0" : fmt::format("{:.1e}", value);
}

std::string factor_text(const Change& change) {
  return change.factor ? fmt::format("x {:.3g}", *change.factor) : "";
}

/// Changes of one verdict beyond the limits, the largest first; those of one row stand together.
std::string section(const char* title, Verdict verdict, const std::vector<Change>& changes,
                    const Terminal& terminal) {
  constexpr std::size_t max_shown = 20, table_width = 64;
  std::vector<std::pair<std::string, std::string>> shown;  // a row, its changes
  for (const Change& c : changes) {
    if (c.verdict != verdict || !c.beyond_limits) continue;
    const std::string row = fmt::format("{}/{}  {}", c.pair, c.pose_class, c.candidate);
    auto at =
        std::find_if(shown.begin(), shown.end(), [&](const auto& s) { return s.first == row; });
    if (at == shown.end()) at = shown.insert(at, {row, ""});
    const std::string before = value_text(c, c.before), after = value_text(c, c.after);
    at->second +=
        terminal.columns < table_width
            ? fmt::format("    {}\n      {} -> {}  {}\n", c.measure, before, after, factor_text(c))
            : fmt::format("    {:<24} {:>10} -> {:>10}  {}\n", c.measure, before, after,
                          factor_text(c));
  }
  if (shown.empty()) return "";
  const std::string heading = fmt::format("{}: {}", title, shown.size());
  const bool is_bad = verdict == Verdict::worse || verdict == Verdict::slower;
  std::string text = '\n' + (is_bad ? terminal.bad(heading) : terminal.good(heading)) + '\n';
  for (std::size_t i = 0; i < std::min(shown.size(), max_shown); ++i) {
    // Its two blanks stay where it fits.
    const std::string& row = shown[i].first;
    const bool fits = row.size() + 2 <= terminal.columns;
    text +=
        "  " + (fits ? row : wrapped(row, terminal.columns - 4, "\n    ")) + '\n' + shown[i].second;
  }
  if (shown.size() > max_shown) {
    text += fmt::format("  and {} more, which --json lists\n", shown.size() - max_shown);
  }
  return text;
}

json to_json(const Comparison& c) {
  json result = object_of(c);
  result["schema"] = "touchstone-comparison-1";
  return result;
}

}  // namespace

std::string comparison_text(const Comparison& c, const Terminal& terminal) {
  std::string text;
  for (const auto& [name, side] : {std::pair("before", &c.before), std::pair("after", &c.after)}) {
    const std::string counts =
        fmt::format("{}, seed {}", counted(side->configurations, "configuration"), side->seed);
    text += fmt::format("{:<8}{}\n", name, wrapped(counts, terminal.columns - 8, "\n        "));
  }
  for (const std::string& remark : c.remarks) {
    text += "- " + wrapped(remark, terminal.columns - 4, "\n  ") + '\n';
  }
  text += section("Worse", Verdict::worse, c.changes, terminal) +
          section("Slower", Verdict::slower, c.changes, terminal) +
          section("Better", Verdict::better, c.changes, terminal) +
          section("Faster", Verdict::faster, c.changes, terminal);
  const auto within = std::count_if(c.changes.begin(), c.changes.end(),
                                    [](const Change& change) { return !change.beyond_limits; });
  text += '\n';
  const auto add = [&](const std::string& line) { text += terminal.folded(line); };
  if (within > 0) add(fmt::format("{}, within the limits.", counted(within, "smaller change")));
  add(fmt::format("{}{} of pair, class and candidate compared.",
                  c.changes.empty() ? "No change. " : "", counted(c.compared, "row")));
  add(fmt::format(
      "Limits: errors {:g} times; times {:g} times, as multiples of {}'s and by the "
      "nearest ends of their spreads; at least {:g}% of what agreed must agree still.",
      c.limits.error_factor, c.limits.time_factor, c.limits.baseline, 100 * c.limits.agreement));
  return text;
}

std::string comparison_json(const Comparison& comparison) {
  return to_json(comparison).dump() + '\n';
}

std::string comparison_page(const Comparison& comparison, const Report& before,
                            const Report& after) {
  std::map<std::string, std::string> runs;
  for (const Report* report : {&before, &after}) {
    for (const CandidateDescription& c : report->candidates) runs[c.name] = c.runs;
  }
  return render_page(Page::comparison, with_candidates({{"comparison", to_json(comparison)},
                                                        {"before", summary_json(before)},
                                                        {"after", summary_json(after)}},
                                                       runs));
}

}  // namespace touchstone
