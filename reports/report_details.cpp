#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

#include "properties/files/given_text.hpp"
#include "reports/factors.hpp"
#include "reports/report.hpp"
#include "reports/row_text.hpp"
#include "reports/tally.hpp"
#include "reports/terminal.hpp"
#include "reports/timing.hpp"

namespace touchstone {
namespace {

std::string titled(const std::string& text, const Terminal& terminal) {
  return terminal.heading(wrapped(text, terminal.columns, "\n")) + '\n';
}

/// Cut downwards like agreement: 1.00 covers every patch.
std::string mean_coverage(const std::optional<Shares>& coverage) {
  if (!coverage) return "-";
  return fmt::format("{:.2f}", std::floor(100 * coverage->mean + 1e-6) / 100);
}

/// A campaign is not timed.
bool is_timed(const Report& report) {
  return std::any_of(report.summary.begin(), report.summary.end(),
                     [](const ResultRow& row) { return row.time.has_value(); });
}

/// "0/12": contacts reported where there are none, and the other way round.
std::string wrong_answers(const Statistics& s) {
  return brief_count(s.of(Outcome::phantom)) + '/' + brief_count(s.of(Outcome::missed));
}

/// A column of the table.
struct TableMeasure {
  TextTable::Column column;
  bool is_of_time;
  std::function<std::string(const ResultRow&)> text;
};

bool has_wrong_answers(const ResultRow& row) {
  return row.statistics.of(Outcome::phantom) + row.statistics.of(Outcome::missed) > 0;
}

/// In the order of the table.
std::vector<TableMeasure> all_measures() {
  const auto of = [](auto text, auto member) {
    return [=](const ResultRow& row) { return text(row.statistics.*member); };
  };
  const auto p99 = [](const std::optional<Quantiles>& q) { return scientific(q, &Quantiles::p99); };
  return {
      {{"agree%", 6, 0}, false, [](const ResultRow& r) { return agreement_text(r.statistics); }},
      {{"yes/no", 7, 3}, false, [](const ResultRow& r) { return wrong_answers(r.statistics); }},
      {{"err", 7, 1}, false, of(p99, &Statistics::depth_error)},
      {{"bias", 8, 6}, false, of(signed_median, &Statistics::bias)},
      {{"pts", 7, 7}, false, of(p99, &Statistics::point_error)},
      {{"cover", 5, 8}, false, of(mean_coverage, &Statistics::coverage)},
      {{"ns", 5, 2}, true, median_time},
      {{"p95", 5, 4},
       true,
       [](const ResultRow& r) { return whole(r.time ? r.time->p95 : std::nullopt); }},
      {{"times", 5, 5}, true, multiple_of_bullet},
  };
}

std::vector<TableMeasure> measures_of(const Report& report) {
  std::vector<TableMeasure> measures = all_measures();
  if (!is_timed(report))
    std::erase_if(measures, [](const TableMeasure& m) { return m.is_of_time; });
  return measures;
}

TextTable table_of(const Report& report, const std::vector<TableMeasure>& measures,
                   const Terminal& terminal) {
  std::size_t name_width = 0;
  for (const ResultRow& row : report.summary) {
    name_width = std::max(name_width, marked_name(report, row).size());
  }
  std::vector<TextTable::Column> columns;
  for (const TableMeasure& m : measures) columns.push_back(m.column);
  return {"candidate", name_width, columns, terminal};
}

std::string row_text(const Report& report, const ResultRow& row,
                     const std::vector<TableMeasure>& measures, const TextTable& table) {
  std::vector<TextTable::Cell> cells;
  for (const TableMeasure& m : measures) {
    cells.push_back({m.text(row), m.column.heading == "yes/no" && has_wrong_answers(row)});
  }
  return table.row(marked_name(report, row), cells, agreement_text(row.statistics) == "100.0");
}

/// One table for each pair of the first group that was scored, then one for all pairs; of the other
/// groups, one for all pairs, or of the only one.
std::string summary_text(const Report& report, const std::vector<TableMeasure>& measures,
                         const TextTable& table, const Terminal& terminal) {
  std::string text, first_group, last;
  const auto has_all = [&](const std::string& group) {
    return std::any_of(report.summary.begin(), report.summary.end(), [&](const ResultRow& row) {
      return row.pose_class == group && row.pair == "all";
    });
  };
  for (const ResultRow& row : report.summary) {
    const Statistics& s = row.statistics;
    if (first_group.empty()) first_group = row.pose_class;
    if (row.pose_class != first_group && row.pair != "all" && has_all(row.pose_class)) continue;
    if (s.supported() == 0) continue;
    const std::string heading =
        fmt::format("{}, {} poses", row.pair == "all" ? "all pairs" : row.pair, row.pose_class);
    if (heading != last) text += '\n' + terminal.heading(heading) + '\n';
    last = heading;
    text += row_text(report, row, measures, table);
  }
  return text;
}

/// What the columns mean, of those that are shown.
std::string columns_text(const Report& report, const TextTable& table, const Terminal& terminal) {
  Legend legend(table, terminal);
  return legend
      .of("agree%", fmt::format("depth, normal and deepest point within {:g} of the smaller size",
                                report.tolerance))
      .of("yes/no", "wrong answers to whether bodies touch: contacts made up, and missed")
      .of("err", "99th percentile of the reported contacts' depth error, in that size")
      .of("bias", "its median with its sign: negative is too deep")
      .of("pts",
          "99th percentile of how far a contact's worst point is outside a body, beyond its depth")
      .of("cover", "mean share of the contact patch that the contact points span")
      .of("ns", "median time of a query")
      .of("p95", "what 95% of the queries do not exceed in the pose class where that is the most")
      .of("times", fmt::format("the median as a multiple of Bullet's, ~ where the spreads of {} to "
                               "{} repetitions overlap: a tie",
                               min_repetitions, max_repetitions))
      .text();
}

/// The pose classes in which a candidate's slow queries take much longer than its median.
std::string tails_text(const Report& report, const Terminal& terminal) {
  std::string text;
  for (const CandidateDescription& candidate : report.candidates) {
    std::size_t timed = 0, slow = 0;
    const ResultRow* slowest = nullptr;
    for (const ResultRow& row : report.results) {
      if (row.candidate != candidate.name || !row.time || !row.time->p95) continue;
      ++timed;
      if (!has_slow_tail(*row.time)) continue;
      ++slow;
      if (!slowest || *row.time->p95 > *slowest->time->p95) slowest = &row;
    }
    if (!slowest) continue;
    text += terminal.below(
        fmt::format("{} in {} of {}; {}/{}: median {} ns, p95 {} ns", candidate.name, slow,
                    counted(timed, "pose class"), slowest->pair, slowest->pose_class,
                    whole(slowest->time->nanoseconds.median), whole(slowest->time->p95)));
  }
  if (text.empty()) return text;
  return '\n' + titled("Slow tails: 5% of the queries take over four medians", terminal) + text;
}

/// The worst failure of a candidate in the first group in which it has one.
const WorstCase* worst_failure(const Report& report, const std::string& candidate) {
  const WorstCase* worst = nullptr;
  for (const WorstCase& w : report.worst) {  // group by group
    if (w.candidate != candidate || agrees(w.score.outcome)) continue;
    if (worst && worst->group != w.group) break;
    if (!worst || is_worse(w.score, worst->score)) worst = &w;
  }
  return worst;
}

std::string failures_text(const Report& report, const Terminal& terminal) {
  std::string text;
  for (const CandidateDescription& candidate : report.candidates) {
    const WorstCase* worst = worst_failure(report, candidate.name);
    if (!worst) continue;
    text += fmt::format("  {} {}, {}\n    {}\n", candidate.name, outcome_name(worst->score.outcome),
                        worst->group, worst->examination.replay);
  }
  if (text.empty()) return text;
  return '\n' +
         titled("Worst failure of each candidate, in everyday poses if it has one there",
                terminal) +
         text;
}

/// What candidates pass as it is and fail turned or tilted.
std::string contrasts_text(const Report& report, const Terminal& terminal) {
  constexpr int max_shown = 3;  // of a candidate
  std::string text, last;
  int shown = 0;
  const auto leave_out = [&] {
    if (shown > max_shown)
      text += fmt::format("    and {} more, in the report\n", shown - max_shown);
  };
  for (const Contrast* c : failing_contrasts(report)) {
    if (c->candidate != last) {
      leave_out();
      text += fmt::format("  {}\n", c->candidate);
      shown = 0;
    }
    last = c->candidate;
    if (++shown > max_shown) continue;
    text += terminal.folded("    " + contrast_text(*c)) + "      " + contrast_command(*c) + '\n';
  }
  leave_out();
  if (text.empty()) return text;
  return '\n' + titled("Passed as it is, failed once turned or tilted", terminal) + text;
}

/// "ode: 6 time-outs; 40 of 200 asked in 2 pose classes", of the classes where it was stopped.
std::string stopped_text(const Report& report, const Terminal& terminal) {
  std::string text;
  for (const CandidateDescription& c : report.candidates) {
    std::uint64_t timeouts = 0, asked = 0, supported = 0, classes = 0;
    for (const ResultRow& row : report.results) {
      if (row.candidate != c.name || !row.statistics.is_stopped()) continue;
      timeouts += row.statistics.of(Outcome::timed_out);
      asked += row.statistics.asked();
      supported += row.statistics.supported();
      ++classes;
    }
    if (classes == 0) continue;
    text += terminal.folded(fmt::format("{}: {}; {} of {} asked in {}", c.name,
                                        counted(timeouts, "time-out"), asked, supported,
                                        counted(classes, "pose class")));
  }
  return text;
}

}  // namespace

std::string terminal_details(const Report& report, const Terminal& terminal) {
  if (const auto nothing = nothing_scored_text(report, terminal); !nothing.empty()) {
    return partial_text(report, terminal) + nothing;
  }
  const std::vector<TableMeasure> measures = measures_of(report);
  const TextTable table = table_of(report, measures, terminal);
  std::string text = partial_text(report, terminal) + table.headings() +
                     summary_text(report, measures, table, terminal) + '\n' +
                     columns_text(report, table, terminal) + marks_text(report, terminal);
  if (std::ranges::any_of(report.summary, [](const ResultRow& row) {
        return row.statistics.of(Outcome::timed_out) > 0;
      })) {
    text += terminal.folded(
        "timed-out: no answer within the limit of processor time; soon after another such answer, "
        "within a hundred times the median, at least a tenth of the limit");
  }
  return text + stopped_text(report, terminal) + tails_text(report, terminal) +
         contrasts_text(report, terminal) + failures_text(report, terminal);
}

}  // namespace touchstone
