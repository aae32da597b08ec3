#include "reports/terminal_table.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "reports/timing.hpp"

namespace touchstone {
namespace {

std::string scientific(const std::optional<Quantiles>& quantiles, double Quantiles::*which) {
  if (!quantiles) return "-";
  const double value = (*quantiles).*which;
  return value == 0 ? "0" : fmt::format("{:.1e}", value);
}

std::string nanoseconds(const std::optional<QueryTime>& time) {
  return time ? fmt::format("{:.0f}", time->nanoseconds.median) : "-";
}

std::string half_spread(const std::optional<QueryTime>& time) {
  if (!time) return "-";
  const auto& [median, low, high] = time->nanoseconds;
  return fmt::format("{:.0f}", std::ceil(50 * (high - low) / median));
}

std::string ratio(const ResultRow& row) {
  if (!row.time || !row.time->ratio_to_bullet) return "-";
  const auto& ties = row.tied_with;
  const bool is_tied = std::find(ties.begin(), ties.end(), "bullet") != ties.end();
  return fmt::format("{}{:.2f}", is_tied ? "~" : "", row.time->ratio_to_bullet->median);
}

std::string partial_text(const Report& report) {
  if (!report.partial) return "";
  return fmt::format(
      "PARTIAL: interrupted when {} of {} pose classes were scored and {} timed.\n\n",
      report.completed.classes, report.planned.classes, report.timed_classes);
}

/// Cut downwards like agreement: 1.00 covers every patch.
std::string mean_coverage(const std::optional<Shares>& coverage) {
  if (!coverage) return "-";
  return fmt::format("{:.2f}", std::floor(100 * coverage->mean + 1e-6) / 100);
}

/// Percentage of the configurations that the candidate has a routine for; cut downwards, so that
/// only a candidate without a failure shows 100%.
std::string agreement(const Statistics& s) {
  const auto count = static_cast<double>(s.count - s.of(Outcome::unsupported));
  const auto agree = static_cast<double>(s.of(Outcome::agree));
  const double percent = std::floor(1000 * agree / count + 1e-6) / 10;
  return fmt::format("{:.1f}", agree == count ? 100.0 : std::min(percent, 99.9));
}

/// A campaign is not timed.
bool is_timed(const Report& report) {
  return std::any_of(report.summary.begin(), report.summary.end(),
                     [](const ResultRow& row) { return row.time.has_value(); });
}

std::string time_columns(const std::string& time, const std::string& spread,
                         const std::string& times_bullet) {
  return fmt::format(" {:>6} {:>4} {:>8}", time, spread, times_bullet);
}

std::string failures_text(const Report& report) {
  std::string text;
  for (const CandidateDescription& candidate : report.candidates) {
    const WorstCase* worst = nullptr;
    for (const WorstCase& w : report.worst) {
      if (w.candidate != candidate.name || w.score.outcome == Outcome::agree) continue;
      if (!worst || w.score.severity > worst->score.severity) worst = &w;
    }
    if (!worst) continue;
    text += fmt::format("  {} {}\n    {}\n", candidate.name, outcome_name(worst->score.outcome),
                        worst->examination.replay);
  }
  return text.empty() ? text : "\nWorst failure of each candidate:\n" + text;
}

}  // namespace

std::string terminal_table(const Report& report) {
  const bool timed = is_timed(report);
  std::string text = partial_text(report);
  text += fmt::format("{:<23}{:>6} {:>6} {:>7} {:>7} {:>5}", "candidate", "agree%", "missed",
                      "err p99", "err max", "cover");
  text += (timed ? time_columns("ns", "+-%", "x bullet") : "") + '\n';
  std::string last_pair;
  for (const ResultRow& row : report.summary) {
    const Statistics& s = row.statistics;
    if (s.of(Outcome::unsupported) == s.count) continue;
    if (row.pair != last_pair) text += '\n' + row.pair + '\n';
    text += fmt::format("  {:<21}{:>6} {:>6} {:>7} {:>7} {:>5}", row.candidate, agreement(s),
                        s.of(Outcome::missed), scientific(s.depth_error, &Quantiles::p99),
                        scientific(s.depth_error, &Quantiles::max), mean_coverage(s.coverage));
    text += timed ? time_columns(nanoseconds(row.time), half_spread(row.time), ratio(row)) : "";
    text += '\n';
    last_pair = row.pair;
  }
  text += fmt::format(
      "\nagree: depth, normal and deepest point within {:g} of the smaller size\n"
      "err: depth error of the contacts that were reported, in the same unit\n"
      "cover: mean share of the contact patch that the contact points span\n",
      report.tolerance);
  if (timed) {
    text += fmt::format(
        "ns, +-%: median of one query, half the spread of {} repetitions (quartiles)\n"
        "x bullet: time as a multiple of Bullet's; ~ where their spreads overlap: a tie\n",
        timing_repetitions);
  }
  return text + failures_text(report);
}

}  // namespace touchstone
