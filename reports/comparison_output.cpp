#include <algorithm>
#include <fmt/format.h>
#include <map>

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

/// "agreement 90.0% -> 80.0% (x 0.889)"
std::string change_text(const Change& c) {
  return fmt::format("{} {} -> {}{}", c.measure, value_text(c, c.before), value_text(c, c.after),
                     c.factor ? fmt::format(" (x {:.3g})", *c.factor) : "");
}

/// What changed, of one verdict, in the classes of a pair for one candidate.
struct Changed {
  const Change* first;                 ///< the largest
  std::vector<const Change*> classes;  ///< of each the change that tells most

  bool is_of(const Change& c) const {
    return first->candidate == c.candidate && first->pair == c.pair;
  }
};

bool is_of_agreement(const Change& c) { return c.measure.starts_with("agreement"); }

/// The changes beyond the limits, the largest first. Agreement tells more than any error.
std::vector<Changed> changed(Verdict verdict, const std::vector<Change>& changes) {
  std::vector<Changed> result;
  for (const Change& c : changes) {
    if (c.verdict != verdict || !c.beyond_limits) continue;
    auto at = std::ranges::find_if(result, [&](const Changed& all) { return all.is_of(c); });
    if (at == result.end()) at = result.insert(at, {&c, {}});
    auto row = std::ranges::find(at->classes, c.pose_class, &Change::pose_class);
    if (row == at->classes.end()) {
      at->classes.push_back(&c);
    } else if (is_of_agreement(c)) {
      *row = &c;
    }
  }
  return result;
}

std::string subject_text(const Changed& changed) {
  return changed.first->pair == "all" ? "all pairs" : changed.first->pair;
}

/// "bullet: worse on cylinder-box, 12 classes, agreement 86.0% -> 71.0%": of those classes.
std::string verdict_text(const Changed& changed) {
  const auto is_group = [](const Change* c) {
    return std::ranges::find(all_groups, c->pose_class, group_name) != std::end(all_groups);
  };
  const bool are_groups = std::ranges::all_of(changed.classes, is_group);
  Change main = *changed.first;
  double before = 0, after = 0, count = 0;
  for (const Change* c : changed.classes) {
    if (!is_of_agreement(*c)) continue;
    main = *c;
    before += c->before;
    after += c->after;
    ++count;
  }
  if (count > 0) main.before = before / count, main.after = after / count;
  main.factor.reset();  // of one class
  return fmt::format("{}: {} on {}, {}, {}", shown_name(main.candidate), verdict_name(main.verdict),
                     subject_text(changed),
                     counted(changed.classes.size(), are_groups ? "group" : "class"),
                     change_text(main));
}

/// A row for each class.
std::string classes_text(const Changed& changed, std::size_t& room, const Terminal& terminal) {
  const Change& first = *changed.first;
  std::size_t width = 0;
  for (const Change* c : changed.classes) width = std::max(width, c->pose_class.size());
  std::string text =
      '\n' +
      terminal.heading(wrapped(fmt::format("{}, {}: {}", first.candidate, subject_text(changed),
                                           verdict_name(first.verdict)),
                               terminal.columns, "\n")) +
      '\n';
  for (const Change* c : changed.classes) {
    if (room == 0) break;
    --room;
    text += terminal.folded(fmt::format("  {:<{}}  {}", c->pose_class, width, change_text(*c)));
  }
  return text;
}

/// The verdicts, a line each, and below them the classes.
std::string changes_text(const Comparison& c, const Terminal& terminal) {
  constexpr std::size_t max_shown = 20;  // classes of each verdict
  std::string verdicts, rows;
  for (const Verdict verdict :
       {Verdict::worse, Verdict::slower, Verdict::better, Verdict::faster}) {
    std::size_t room = max_shown, all = 0;
    const bool is_bad = verdict == Verdict::worse || verdict == Verdict::slower;
    for (const Changed& each : changed(verdict, c.changes)) {
      const std::string line = wrapped(verdict_text(each), terminal.columns, "\n");
      verdicts += (is_bad ? terminal.bad(line) : terminal.good(line)) + '\n';
      if (room > 0) rows += classes_text(each, room, terminal);
      all += each.classes.size();
    }
    if (all > max_shown) rows += fmt::format("and {} more, which --json lists\n", all - max_shown);
  }
  if (verdicts.empty())
    return c.changes.empty() ? "No change.\n" : "No change beyond the limits.\n";
  return verdicts + rows;
}

json to_json(const Comparison& c) {
  json result = object_of(c);
  result["schema"] = "touchstone-comparison-1";
  return result;
}

}  // namespace

std::string comparison_text(const Comparison& c, const Terminal& terminal) {
  std::string text = changes_text(c, terminal) + '\n';
  const auto add = [&](const std::string& line) { text += terminal.folded(line); };
  for (const std::string& remark : c.remarks) {
    text += "- " + wrapped(remark, terminal.columns - 4, "\n  ") + '\n';
  }
  const auto side = [](const Comparison::Side& s) {
    return fmt::format("{}, seed {}", counted(s.configurations, "configuration"), s.seed);
  };
  add(fmt::format("{} of pair, class and candidate compared; before: {}; after: {}.",
                  counted(c.compared, "row"), side(c.before), side(c.after)));
  const auto within = std::ranges::count(c.changes, false, &Change::beyond_limits);
  if (within > 0) add(fmt::format("{}, within the limits.", counted(within, "smaller change")));
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
