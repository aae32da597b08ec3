// The first screen of a report: which candidate is right, how fast it is, where it fails.
#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "reports/findings.hpp"
#include "reports/report.hpp"
#include "reports/row_text.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

/// What a report says of one candidate in each group of poses: the row over all pairs, or of the
/// only one; null where it has no routine.
struct Standing {
  std::string name;
  std::vector<const ResultRow*> rows;

  /// Of the first group, which all columns but the shares of the others are about.
  const ResultRow* first() const { return rows.front(); }
  /// Our own routine is not one of those to choose from: it stands below them.
  bool is_yardstick() const { return name == "reference"; }
};

std::vector<std::string> groups_of(const Report& report) {
  std::vector<std::string> groups;
  for (const ResultRow& row : report.summary) {
    if (groups.empty() || groups.back() != row.pose_class) groups.push_back(row.pose_class);
  }
  return groups;
}

Standing standing_of(const Report& report, const std::vector<std::string>& groups,
                     const std::string& candidate) {
  Standing result{candidate, {}};
  for (const std::string& group : groups) {
    const ResultRow*& last = result.rows.emplace_back(nullptr);
    for (const ResultRow& row : report.summary) {  // that over all pairs is the last
      const bool is_of = row.pose_class == group && row.candidate == candidate;
      if (is_of && row.statistics.supported() > 0) last = &row;
    }
  }
  return result;
}

/// The best first: by agreement in each group, then by error and time in the first one.
bool is_better(const Standing& a, const Standing& b) {
  const auto order = [](const Standing& s) {
    constexpr double none = std::numeric_limits<double>::infinity();
    std::vector<double> less_is_better = {s.is_yardstick() ? 1.0 : 0.0};
    for (const ResultRow* row : s.rows) {
      less_is_better.push_back(row ? -row->statistics.agreement() : none);
    }
    const ResultRow* const row = s.first();
    const bool has_error = row && row->statistics.depth_error, has_time = row && row->time;
    less_is_better.push_back(has_error ? row->statistics.depth_error->p99 : none);
    less_is_better.push_back(has_time ? row->time->nanoseconds.median : none);
    return less_is_better;
  };
  return order(a) < order(b);
}

std::string heading_of(const std::string& group) {
  return group == "degenerate" ? "degen." : group;
}

TextTable standings_table(const Report& report, const std::vector<std::string>& groups,
                          std::size_t name_width, const Terminal& terminal) {
  std::vector<TextTable::Column> columns;
  for (const std::string& group : groups) {
    const int rank = columns.empty() ? 0 : 5 + static_cast<int>(columns.size());
    columns.push_back({heading_of(group), heading_of(group).size(), rank});
  }
  columns.insert(columns.end(), {{"missed", 6, 2}, {"made up", 7, 3}, {"err p99", 7, 5}});
  const auto has_time = [](const ResultRow& row) { return row.time.has_value(); };
  if (std::ranges::any_of(report.summary, has_time)) {
    columns.insert(columns.end(), {{"ns", 5, 1}, {"times", 5, 4}});
  }
  return {"candidate", name_width, columns, terminal};
}

std::string row_of(const Standing& standing, const std::string& name, const TextTable& table) {
  std::vector<TextTable::Cell> cells;
  bool is_right = true;
  for (const ResultRow* row : standing.rows) {
    cells.push_back({row ? agreement_text(row->statistics) : "-"});
    is_right = is_right && cells.back().text == "100.0";
  }
  if (const ResultRow* const row = standing.first()) {
    const Statistics& s = row->statistics;
    for (const Outcome wrong : {Outcome::missed, Outcome::phantom}) {
      cells.push_back({brief_count(s.of(wrong)), s.of(wrong) > 0});
    }
    for (const std::string& text : {scientific(s.depth_error, &Quantiles::p99), median_time(*row),
                                    multiple_of_bullet(*row)}) {
      cells.push_back({text});
    }
  }
  cells.resize(standing.rows.size() + 5, {"-"});
  return table.row(name, cells, is_right);
}

std::string legend_of(const Report& report, const std::vector<std::string>& groups,
                      const TextTable& table, const Terminal& terminal) {
  std::vector<std::string> shown;
  for (const std::string& group : groups) {
    if (table.has(heading_of(group))) shown.push_back(heading_of(group));
  }
  Legend legend(table, terminal);
  return legend
      .line(fmt::format("{}: % of these poses answered right, within {:g} of the smaller size in "
                        "depth, normal and contact points. Of {} poses alone:",
                        fmt::join(shown, ", "), report.tolerance, groups.front()))
      .of("missed", "contacts not seen; made up: contacts where there are none")
      .of("err p99", "depth error that 1% of the contacts exceed, in that size")
      .of("ns", "median time of a query; times: as a multiple of bullet's, ~: a tie")
      .text();
}

std::string findings_text(const Report& report, const Terminal& terminal) {
  std::string text;
  for (const Finding& f : findings(report)) {
    text += terminal.folded(f.text) + "  " + f.command + '\n';
  }
  return text.empty() ? text : '\n' + terminal.heading("Findings") + '\n' + text;
}

}  // namespace

std::string terminal_table(const Report& report, const Terminal& terminal) {
  const std::vector<std::string> groups = groups_of(report);
  if (groups.empty()) return partial_text(report, terminal);
  if (const auto nothing = nothing_scored_text(report, terminal); !nothing.empty()) {
    return partial_text(report, terminal) + nothing;
  }
  std::vector<Standing> standings;
  for (const CandidateDescription& c : report.candidates) {
    standings.push_back(standing_of(report, groups, c.name));
  }
  std::ranges::stable_sort(standings, is_better);
  const auto shown = [&](const Standing& s) {
    return s.is_yardstick() || !s.first() ? shown_name(s.name) : marked_name(report, *s.first());
  };
  std::size_t name_width = 0;
  for (const Standing& s : standings) {
    if (!s.is_yardstick()) name_width = std::max(name_width, shown(s).size());
  }
  const TextTable table = standings_table(report, groups, name_width, terminal);
  std::string text = partial_text(report, terminal) + table.headings();
  for (const Standing& s : standings) {
    if (s.is_yardstick() && standings.size() > 1) text += '\n';
    text += row_of(s, shown(s), table);
  }
  return text + '\n' + legend_of(report, groups, table, terminal) + marks_text(report, terminal) +
         findings_text(report, terminal) + casts_text(report, terminal);
}

}  // namespace touchstone
