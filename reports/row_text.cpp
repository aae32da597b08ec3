#include "reports/row_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <vector>

#include "reports/sampler.hpp"

namespace touchstone {
namespace {

bool is_zero(double value) { return std::abs(value) < std::numeric_limits<double>::min(); }

/// Empty where it has a routine for all pairs.
std::string covered_mark(const Report& report, const ResultRow& row) {
  if (row.pair != "all") return "";
  const CoveredPairs pairs = covered_pairs(report, row.pose_class, row.candidate);
  return pairs.are_all() ? "" : fmt::format(" {}/{}", pairs.covered, pairs.all);
}

}  // namespace

CoveredPairs covered_pairs(const Report& report, const std::string& group,
                           const std::string& candidate) {
  CoveredPairs result;
  for (const ResultRow& row : report.summary) {
    if (row.pair == "all" || row.pose_class != group || row.candidate != candidate) continue;
    ++result.all;
    result.covered += row.statistics.supported() > 0;
  }
  return result;
}

std::string CoveredPairs::text() const {
  return are_all() ? "" : fmt::format(" ({} of {} pairs)", covered, all);
}

std::string covered_text(const Report& report, const ResultRow& row) {
  return row.pair == "all" ? covered_pairs(report, row.pose_class, row.candidate).text() : "";
}

std::string agreement_text(const Statistics& s) {
  if (s.supported() == 0) return "-";
  const double share = s.agreement(), percent = std::floor(1000 * share + 1e-6) / 10;
  return fmt::format("{}{:.1f}", s.is_stopped() ? ">=" : "",
                     share == 1 ? 100.0 : std::min(percent, 99.9));
}

std::string scientific(const std::optional<Quantiles>& quantiles, double Quantiles::*which) {
  if (!quantiles) return "-";
  const double value = (*quantiles).*which;
  return is_zero(value) ? "0" : fmt::format("{:.1e}", value);
}

std::string signed_median(const std::optional<SignedMedian>& bias) {
  if (!bias) return "-";
  return is_zero(bias->value) ? "0" : fmt::format("{:+.1e}", bias->value);
}

std::string brief_count(std::uint64_t count) {
  constexpr std::uint64_t thousand = 1000, million = thousand * thousand;
  if (count < thousand) return fmt::format("{}", count);
  if (count < million) return fmt::format("{}k", count / thousand);
  return fmt::format("{}M", count / million);
}

std::string whole(const std::optional<double>& value) {
  return value ? fmt::format("{:.0f}", *value) : "-";
}

std::string median_time(const ResultRow& row) {
  return row.time ? whole(row.time->nanoseconds.median) : "-";
}

std::string multiple_of_bullet(const ResultRow& row) {
  if (!row.time || !row.time->ratio_to_bullet) return "-";
  const bool is_tied = std::ranges::find(row.tied_with, "bullet") != row.tied_with.end();
  return fmt::format("{}{:.2f}", is_tied ? "~" : "", row.time->ratio_to_bullet->median);
}

std::string marked_name(const Report& report, const ResultRow& row) {
  const bool is_starred = std::ranges::any_of(
      report.candidates,
      [&](const CandidateDescription& c) { return c.name == row.candidate && c.runs != "native"; });
  return row.candidate + (is_starred ? "*" : "") + covered_mark(report, row);
}

std::string partial_text(const Report& report, const Terminal& terminal) {
  if (!report.partial) return "";
  return terminal.folded(fmt::format(
             "PARTIAL: interrupted when {} of {} pose classes were scored and {} timed.",
             report.completed.classes, report.planned.classes, report.timed_classes)) +
         '\n';
}

std::string nothing_scored_text(const Report& report, const Terminal& terminal) {
  const auto is_scored = [](const ResultRow& row) { return row.statistics.supported() > 0; };
  if (report.summary.empty() || std::ranges::any_of(report.summary, is_scored)) return "";
  std::vector<std::string> names;
  for (const CandidateDescription& c : report.candidates) names.push_back(c.name);
  return terminal.folded(fmt::format(
      "Nothing was scored: {} \"unsupported\" to every configuration, as a routine that "
      "is not made for such a pair of shapes does.",
      names.size() == 1 ? names.front() + " answers"
                        : fmt::format("{} answer", fmt::join(names, ", "))));
}

namespace {

/// What a candidate that is a command says of its time, against what is known of it.
std::string command_text(const Report& report, const CandidateDescription& c) {
  std::string text = fmt::format("* {} runs as {}", c.name, c.runs);
  double floor = 0, low = 1, high = 1;
  for (const ResultRow& row : report.summary) {
    if (row.candidate != c.name || !row.time || !row.time->measured) continue;
    const auto& [of_row, our_clock, processor] = *row.time->measured;
    floor = std::max(floor, of_row);
    low = std::min(low, our_clock);
    high = std::max({high, our_clock, processor});  // less: it was kept waiting
  }
  if (floor > 0) text += fmt::format("; bodies far apart: up to {:.0f} ns", floor);
  if (low < 0.9 || high > 1.1) {
    text += fmt::format(
        "; the times it gives are doubtful: by our clocks they are {:.2f} to {:.2f} times as long",
        low, high);
  }
  return text;
}

}  // namespace

std::string marks_text(const Report& report, const Terminal& terminal) {
  std::string text;
  const auto any = [&](const auto& is) { return std::ranges::any_of(report.summary, is); };
  if (any([&](const ResultRow& row) {
        return row.statistics.supported() > 0 && !covered_mark(report, row).empty();
      })) {
    text += terminal.folded(
        "5/6: over five of six pairs, for the candidate has no routine for the other");
  }
  if (any([](const ResultRow& row) { return row.statistics.is_stopped(); })) {
    text += terminal.folded(fmt::format(
        ">=: stopped after {} time-outs among up to {} configurations of a class; what was not "
        "asked counts as wrong",
        max_timeouts, Unit::max_size));
  }
  for (const CandidateDescription& c : report.candidates) {
    if (c.runs != "native") text += terminal.folded(command_text(report, c));
  }
  return text;
}

}  // namespace touchstone
