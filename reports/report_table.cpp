#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <string_view>

#include "properties/files/given_text.hpp"
#include "reports/covered_pairs.hpp"
#include "reports/factors.hpp"
#include "reports/replay.hpp"
#include "reports/report.hpp"
#include "reports/sampler.hpp"
#include "reports/tally.hpp"
#include "reports/terminal.hpp"
#include "reports/timing.hpp"

namespace touchstone {
namespace {

/// Below the normal doubles a campaign's histogram knows but the bin that zero is in.
bool is_zero(double value) { return std::abs(value) < std::numeric_limits<double>::min(); }

std::string scientific(const std::optional<Quantiles>& quantiles, double Quantiles::*which) {
  if (!quantiles) return "-";
  const double value = (*quantiles).*which;
  return is_zero(value) ? "0" : fmt::format("{:.1e}", value);
}

std::string whole(const std::optional<double>& value) {
  return value ? fmt::format("{:.0f}", *value) : "-";
}

std::string median_time(const ResultRow& row) {
  return row.time ? whole(row.time->nanoseconds.median) : "-";
}

std::string ratio(const ResultRow& row) {
  if (!row.time || !row.time->ratio_to_bullet) return "-";
  const auto& ties = row.tied_with;
  const bool is_tied = std::find(ties.begin(), ties.end(), "bullet") != ties.end();
  return fmt::format("{}{:.2f}", is_tied ? "~" : "", row.time->ratio_to_bullet->median);
}

/// The text within the terminal's columns, all lines but the first indented by two.
std::string indented(const std::string& text, const Terminal& terminal) {
  return wrapped(text, terminal.columns - 2, "\n  ");
}

std::string titled(const std::string& text, const Terminal& terminal) {
  return terminal.heading(wrapped(text, terminal.columns, "\n"));
}

std::string partial_text(const Report& report, const Terminal& terminal) {
  if (!report.partial) return "";
  return indented(fmt::format(
                      "PARTIAL: interrupted when {} of {} pose classes were scored and {} timed.",
                      report.completed.classes, report.planned.classes, report.timed_classes),
                  terminal) +
         "\n\n";
}

/// Cut downwards like agreement: 1.00 covers every patch.
std::string mean_coverage(const std::optional<Shares>& coverage) {
  if (!coverage) return "-";
  return fmt::format("{:.2f}", std::floor(100 * coverage->mean + 1e-6) / 100);
}

/// Percentage of the configurations that the candidate has a routine for; cut downwards, so that
/// only a candidate without a failure shows 100%. ">=27.0" of one that was not asked all.
std::string agreement(const Statistics& s) {
  const double share = s.agreement(), percent = std::floor(1000 * share + 1e-6) / 10;
  return fmt::format("{}{:.1f}", s.is_stopped() ? ">=" : "",
                     share == 1 ? 100.0 : std::min(percent, 99.9));
}

/// A campaign is not timed.
bool is_timed(const Report& report) {
  return std::any_of(report.summary.begin(), report.summary.end(),
                     [](const ResultRow& row) { return row.time.has_value(); });
}

/// Few characters, cut downwards: "999", "1k", "340k".
std::string brief_count(std::uint64_t count) {
  constexpr std::uint64_t thousand = 1000, million = thousand * thousand;
  if (count < thousand) return fmt::format("{}", count);
  if (count < million) return fmt::format("{}k", count / thousand);
  return fmt::format("{}M", count / million);
}

/// "0/12": contacts reported where there are none, and the other way round.
std::string wrong_answers(const Statistics& s) {
  return brief_count(s.of(Outcome::phantom)) + '/' + brief_count(s.of(Outcome::missed));
}

std::string signed_median(const std::optional<SignedMedian>& bias) {
  if (!bias) return "-";
  return is_zero(bias->value) ? "0" : fmt::format("{:+.1e}", bias->value);
}

/// "4/5" beside a name: a row over all pairs is over these alone. Empty where it is over all.
std::string covered_mark(const Report& report, const std::string& group,
                         const std::string& candidate) {
  const CoveredPairs pairs = covered_pairs(report, group, candidate);
  return pairs.are_all() ? "" : fmt::format(" {}/{}", pairs.covered, pairs.all);
}

/// Candidates that do not run as native code have a star.
bool is_starred(const Report& report, const std::string& candidate) {
  return std::any_of(
      report.candidates.begin(), report.candidates.end(),
      [&](const CandidateDescription& c) { return c.name == candidate && c.runs != "native"; });
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
      {{"agree%", 6, 0}, false, [](const ResultRow& r) { return agreement(r.statistics); }},
      {{"yes/no", 7, 3}, false, [](const ResultRow& r) { return wrong_answers(r.statistics); }},
      {{"err", 7, 1}, false, of(p99, &Statistics::depth_error)},
      {{"bias", 8, 6}, false, of(signed_median, &Statistics::bias)},
      {{"pts", 7, 7}, false, of(p99, &Statistics::point_error)},
      {{"cover", 5, 8}, false, of(mean_coverage, &Statistics::coverage)},
      {{"ns", 5, 2}, true, median_time},
      {{"p95", 5, 4},
       true,
       [](const ResultRow& r) { return whole(r.time ? r.time->p95 : std::nullopt); }},
      {{"times", 5, 5}, true, ratio},
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
  for (const CandidateDescription& c : report.candidates) {
    name_width = std::max(name_width, c.name.size() + (c.runs == "native" ? 0 : 1));
  }
  for (const ResultRow& row : report.summary) {
    if (row.pair != "all" || row.statistics.supported() == 0) continue;
    name_width =
        std::max(name_width, row.candidate.size() + (is_starred(report, row.candidate)) +
                                 covered_mark(report, row.pose_class, row.candidate).size());
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
  const std::string name =
      row.candidate + (is_starred(report, row.candidate) ? "*" : "") +
      (row.pair == "all" ? covered_mark(report, row.pose_class, row.candidate) : "");
  return table.row(name, cells, agreement(row.statistics) == "100.0");
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
  std::string text = "\n";
  const auto explain = [&](const char* column, const std::string& meaning) {
    if (!table.has(column)) return;
    text += indented(fmt::format("{}: {}", column, meaning), terminal) + '\n';
  };
  explain("agree%", fmt::format("depth, normal and deepest point within {:g} of the smaller size",
                                report.tolerance));
  explain("yes/no", "wrong answers to whether bodies touch: contacts made up, and missed");
  explain("err", "99th percentile of the reported contacts' depth error, in that size");
  explain("bias", "its median with its sign: negative is too deep");
  explain("pts",
          "99th percentile of how far a contact's worst point is outside a body, beyond its "
          "depth");
  explain("cover", "mean share of the contact patch that the contact points span");
  explain("ns", "median time of a query");
  explain("p95", "what 95% of the queries do not exceed in the pose class where that is the most");
  explain("times", fmt::format("the median as a multiple of Bullet's, ~ where the spreads of {} to "
                               "{} repetitions overlap: a tie",
                               min_repetitions, max_repetitions));
  const auto is_partial = [&](const ResultRow& row) {
    return row.pair == "all" && row.statistics.supported() > 0 &&
           !covered_mark(report, row.pose_class, row.candidate).empty();
  };
  if (std::any_of(report.summary.begin(), report.summary.end(), is_partial)) {
    text += indented("4/5: over four of five pairs, for the candidate has no routine for the other",
                     terminal) +
            '\n';
  }
  return text + table.what_is_left_out();
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
  return '\n' + titled("Slow tails: 5% of the queries take over four medians", terminal) + '\n' +
         text;
}

/// What a candidate that is a command says of its time, against what is known of it.
std::string commands_text(const Report& report, bool timed, const Terminal& terminal) {
  std::string text;
  for (const CandidateDescription& c : report.candidates) {
    if (c.runs != "native") text += fmt::format("* {} runs as {}\n", c.name, c.runs);
    if (!timed) continue;
    double floor = 0, low = 1, high = 1;
    for (const ResultRow& row : report.summary) {
      if (row.candidate != c.name || !row.time || !row.time->measured) continue;
      const auto& [of_row, our_clock, processor] = *row.time->measured;
      floor = std::max(floor, of_row);
      low = std::min(low, our_clock);
      high = std::max({high, our_clock, processor});  // less: it was kept waiting
    }
    if (floor > 0) text += fmt::format("  bodies far apart: up to {:.0f} ns\n", floor);
    if (low < 0.9 || high > 1.1) {
      text += terminal.below(
          fmt::format("the times it gives are doubtful: by our clocks they are {:.2f} to {:.2f} "
                      "times as long",
                      low, high));
    }
  }
  return text;
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
  const std::string title =
      "Worst failure of each candidate, in everyday poses if it has one there";
  return '\n' + terminal.heading(wrapped(title, terminal.columns, "\n")) + '\n' + text;
}

bool can_be_asked(const Report& report, const std::string& candidate) {
  return std::none_of(
      report.candidates.begin(), report.candidates.end(),
      [&](const CandidateDescription& c) { return c.name == candidate && c.given; });
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
    text += fmt::format(
        "    {}\n      {}\n", wrapped(contrast_text(*c), terminal.columns - 6, "\n      "),
        can_be_asked(report, c->candidate) ? contrast_command(*c) : replay_command(c->worst, {}));
  }
  leave_out();
  if (text.empty()) return text;
  return '\n' + titled("Passed as it is, failed once turned or tilted", terminal) + '\n' + text;
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
    text +=
        indented(fmt::format("{}: {}; {} of {} asked in {}", c.name, counted(timeouts, "time-out"),
                             asked, supported, counted(classes, "pose class")),
                 terminal) +
        '\n';
  }
  if (text.empty()) return text;
  return indented(fmt::format(">=: stopped after {} time-outs among up to {} configurations of a "
                              "class; agree% counts what was not asked as wrong",
                              max_timeouts, Unit::max_size),
                  terminal) +
         '\n' + text;
}

}  // namespace

std::string terminal_table(const Report& report, const Terminal& terminal) {
  const bool timed = is_timed(report);
  const std::vector<TableMeasure> measures = measures_of(report);
  const TextTable table = table_of(report, measures, terminal);
  std::string text = partial_text(report, terminal) + table.headings() +
                     summary_text(report, measures, table, terminal) +
                     columns_text(report, table, terminal);
  const bool has_timeouts =
      std::any_of(report.summary.begin(), report.summary.end(),
                  [](const ResultRow& row) { return row.statistics.of(Outcome::timed_out) > 0; });
  if (has_timeouts) {
    text += indented(
                "timed-out: no answer within the limit of processor time; soon after another "
                "such answer, within a hundred times the median, at least a tenth of the "
                "limit",
                terminal) +
            '\n';
  }
  return text + stopped_text(report, terminal) + commands_text(report, timed, terminal) +
         tails_text(report, terminal) + contrasts_text(report, terminal) +
         failures_text(report, terminal);
}

}  // namespace touchstone
