#include "reports/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

#include "reports/factors.hpp"
#include "reports/replay.hpp"
#include "reports/report.hpp"
#include "reports/tally.hpp"
#include "reports/timing.hpp"

namespace touchstone {
namespace {

constexpr std::size_t min_columns = 40, max_columns = 80;

/// Select graphic rendition, ECMA-48 8.3.117.
std::string rendered(const Terminal& terminal, const char* parameter, const std::string& text) {
  if (!terminal.has_colours) return text;
  return std::string("\x1b[") + parameter + 'm' + text + "\x1b[0m";
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value != '\0';
}

bool is_dumb() {
  const char* name = std::getenv("TERM");
  return !name || std::string_view(name) == "dumb";
}

}  // namespace

std::string Terminal::heading(const std::string& text) const { return rendered(*this, "1", text); }
std::string Terminal::good(const std::string& text) const { return rendered(*this, "32", text); }
std::string Terminal::bad(const std::string& text) const { return rendered(*this, "31", text); }

Terminal standard_output() {
  Terminal result;
  if (isatty(STDOUT_FILENO) == 0) return result;
  result.has_colours = !is_set("NO_COLOR") && !is_dumb();
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    result.columns = std::clamp<std::size_t>(size.ws_col, min_columns, max_columns);
  }
  return result;
}

namespace {

std::string scientific(const std::optional<Quantiles>& quantiles, double Quantiles::*which) {
  if (!quantiles) return "-";
  const double value = (*quantiles).*which;
  return value == 0 ? "0" : fmt::format("{:.1e}", value);
}

std::string nanoseconds(const std::optional<QueryTime>& time) {
  return time ? fmt::format("{:.0f}", time->nanoseconds.median) : "-";
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
  return bias->value == 0 ? "0" : fmt::format("{:+.1e}", bias->value);
}

std::string time_columns(const std::string& time, const std::string& times_bullet) {
  return fmt::format(" {:>6} {:>5}", time, times_bullet);
}

/// Candidates that do not run as native code have a star.
bool is_starred(const Report& report, const std::string& candidate) {
  return std::any_of(
      report.candidates.begin(), report.candidates.end(),
      [&](const CandidateDescription& c) { return c.name == candidate && c.runs != "native"; });
}

std::string row_text(const Report& report, const ResultRow& row, bool timed) {
  const Statistics& s = row.statistics;
  const std::string name = row.candidate + (is_starred(report, row.candidate) ? "*" : "");
  return fmt::format("{:<21} {:>6} {:>7} {:>7} {:>8} {:>7} {:>5}{}\n", name, agreement(s),
                     wrong_answers(s), scientific(s.depth_error, &Quantiles::p99),
                     signed_median(s.bias), scientific(s.point_error, &Quantiles::p99),
                     mean_coverage(s.coverage),
                     timed ? time_columns(nanoseconds(row.time), ratio(row)) : "");
}

/// One table for each pair of the first group that was scored, then one for all pairs; of the other
/// groups, one for all pairs, or of the only one.
std::string summary_text(const Report& report, bool timed) {
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
    if (s.of(Outcome::unsupported) == s.count) continue;
    const std::string heading =
        fmt::format("\n{}, {} poses\n", row.pair == "all" ? "all pairs" : row.pair, row.pose_class);
    if (heading != last) text += heading;
    last = heading;
    text += row_text(report, row, timed);
  }
  return text;
}

/// What a candidate that is a command says of its time, against what is known of it.
std::string commands_text(const Report& report, bool timed) {
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
      text += fmt::format("  its times are doubtful: ours are {:.2f} to {:.2f} times as long\n",
                          low, high);
    }
  }
  return text;
}

/// The worst failure of a candidate in the first group in which it has one.
const WorstCase* worst_failure(const Report& report, const std::string& candidate) {
  const WorstCase* worst = nullptr;
  for (const WorstCase& w : report.worst) {  // group by group
    if (w.candidate != candidate || w.score.outcome == Outcome::agree) continue;
    if (worst && worst->group != w.group) break;
    if (!worst || is_worse(w.score, worst->score)) worst = &w;
  }
  return worst;
}

std::string failures_text(const Report& report) {
  std::string text;
  for (const CandidateDescription& candidate : report.candidates) {
    const WorstCase* worst = worst_failure(report, candidate.name);
    if (!worst) continue;
    text += fmt::format("  {} {}, {}\n    {}\n", candidate.name, outcome_name(worst->score.outcome),
                        worst->group, worst->examination.replay);
  }
  return text.empty()
             ? text
             : "\nWorst failure of each candidate, in everyday poses if it has one there:\n" + text;
}

bool can_be_asked(const Report& report, const std::string& candidate) {
  return std::none_of(
      report.candidates.begin(), report.candidates.end(),
      [&](const CandidateDescription& c) { return c.name == candidate && c.given; });
}

/// What candidates pass as it is and fail turned or tilted.
std::string contrasts_text(const Report& report) {
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
        "    {}\n      {}\n", contrast_text(*c),
        can_be_asked(report, c->candidate) ? contrast_command(*c) : replay_command(c->worst, {}));
  }
  leave_out();
  return text.empty() ? text : "\nPassed as it is, failed once turned or tilted:\n" + text;
}

}  // namespace

std::string terminal_table(const Report& report) {
  const bool timed = is_timed(report);
  std::string text = partial_text(report);
  text +=
      fmt::format("{:<21} {:>6} {:>7} {:>7} {:>8} {:>7} {:>5}{}\n", "candidate", "agree%", "yes/no",
                  "err p99", "bias", "pts p99", "cover", timed ? time_columns("ns", "times") : "");
  text += summary_text(report, timed);
  text += fmt::format(
      "\nagree%: depth, normal and deepest point within {:g} of the smaller size\n"
      "yes/no: wrong answers to whether bodies touch: contacts made up, and missed\n"
      "err, bias: depth error of the contacts that were reported, in the same unit;\n"
      "  its median with its sign: negative is too deep\n"
      "pts: by how much the worst contact point is off both surfaces and its depth\n"
      "cover: mean share of the contact patch that the contact points span\n",
      report.tolerance);
  if (timed) {
    text += fmt::format(
        "ns, times: median of one query; as a multiple of Bullet's, ~ where the spreads\n"
        "  of {} to {} repetitions overlap: a tie\n",
        min_repetitions, max_repetitions);
  }
  const bool has_timeouts =
      std::any_of(report.summary.begin(), report.summary.end(),
                  [](const ResultRow& row) { return row.statistics.of(Outcome::timed_out) > 0; });
  if (has_timeouts) {
    text +=
        "timed-out: no answer within the limit of processor time; soon after another\n"
        "  such answer, within a thousand times the median, at least a tenth of the limit\n";
  }
  return text + commands_text(report, timed) + contrasts_text(report) + failures_text(report);
}

}  // namespace touchstone
