#include "reports/terminal_table.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "reports/timing.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::string scientific(const json& quantiles, const char* which) {
  if (quantiles.is_null()) return "-";
  const double value = quantiles[which];
  return value == 0 ? "0" : fmt::format("{:.1e}", value);
}

std::string nanoseconds(const json& time) {
  return time.is_null() ? "-" : fmt::format("{:.0f}", time["median"].get<double>());
}

std::string half_spread(const json& time) {
  if (time.is_null()) return "-";
  const double percent = 50 * time["spread"].get<double>() / time["median"].get<double>();
  return fmt::format("{:.0f}", std::ceil(percent));
}

std::string ratio(const json& row) {
  const json& time = row["nanoseconds"];
  if (time.is_null() || time["ratio_to_bullet"].is_null()) return "-";
  const json ties = row.value("tied_with", json::array());
  const bool tied = std::find(ties.begin(), ties.end(), "bullet") != ties.end();
  return fmt::format("{}{:.2f}", tied ? "~" : "", time["ratio_to_bullet"].get<double>());
}

std::string partial_text(const json& report) {
  if (!report.value("partial", false)) return "";
  const json &done = report["completed"], &planned = report["planned"];
  return fmt::format(
      "PARTIAL: interrupted when {} of {} pose classes were scored and {} timed.\n\n",
      done["classes"].get<std::size_t>(), planned["classes"].get<std::size_t>(),
      done["timed_classes"].get<std::size_t>());
}

/// Cut downwards like agreement: 1.00 covers every patch.
std::string mean_coverage(const json& row) {
  if (row["coverage"].is_null()) return "-";
  return fmt::format("{:.2f}",
                     std::floor(100 * row["coverage"]["mean"].get<double>() + 1e-6) / 100);
}

/// Of the configurations that it has a routine for; cut downwards, so that only a candidate without
/// a failure shows 100%.
std::string agreement(const json& row) {
  const double count = row["count"].get<double>() - row["outcomes"].value("unsupported", 0);
  const double agree = row["outcomes"].value("agree", 0);
  const double percent = std::floor(1000 * agree / count + 1e-6) / 10;
  return fmt::format("{:.1f}", agree == count ? 100.0 : std::min(percent, 99.9));
}

/// A campaign is not timed.
bool is_timed(const json& summary) {
  return std::any_of(summary.begin(), summary.end(),
                     [](const json& row) { return !row["nanoseconds"].is_null(); });
}

std::string time_columns(const std::string& time, const std::string& spread,
                         const std::string& times_bullet) {
  return fmt::format(" {:>6} {:>4} {:>8}", time, spread, times_bullet);
}

}  // namespace

std::string terminal_table(const json& report) {
  const bool timed = is_timed(report["summary"]);
  std::string text = partial_text(report);
  text += fmt::format("{:<23}{:>6} {:>6} {:>7} {:>7} {:>5}", "candidate", "agree%", "missed",
                      "err p99", "err max", "cover");
  text += (timed ? time_columns("ns", "+-%", "x bullet") : "") + '\n';
  std::string last_pair;
  for (const json& row : report["summary"]) {
    if (row["outcomes"].value("unsupported", 0) == row["count"]) continue;
    const std::string pair = row["pair"];
    if (pair != last_pair) text += '\n' + pair + '\n';
    text += fmt::format("  {:<21}{:>6} {:>6} {:>7} {:>7} {:>5}",
                        row["candidate"].get<std::string>(), agreement(row),
                        row["outcomes"].value("missed", 0), scientific(row["depth_error"], "p99"),
                        scientific(row["depth_error"], "max"), mean_coverage(row));
    const json& time = row["nanoseconds"];
    text += (timed ? time_columns(nanoseconds(time), half_spread(time), ratio(row)) : "") + '\n';
    last_pair = pair;
  }
  text += fmt::format(
      "\nagree: depth, normal and deepest point within {:g} of the smaller size\n"
      "err: depth error of the contacts that were reported, in the same unit\n"
      "cover: mean share of the contact patch that the contact points span\n",
      report["tolerance"].get<double>());
  if (timed) {
    text += fmt::format(
        "ns, +-%: median of one query, half the spread of {} repetitions (quartiles)\n"
        "x bullet: time as a multiple of Bullet's; ~ where their spreads overlap: a tie\n",
        timing_repetitions);
  }

  std::string failures;
  for (const json& candidate : report["candidates"]) {
    const json* worst = nullptr;
    for (const json& w : report["worst"]) {
      if (w["candidate"] != candidate["name"] || w["outcome"] == "agree") continue;
      if (!worst || w["severity"] > (*worst)["severity"]) worst = &w;
    }
    if (!worst) continue;
    failures +=
        fmt::format("  {} {}\n    {}\n", candidate["name"].get<std::string>(),
                    (*worst)["outcome"].get<std::string>(), (*worst)["replay"].get<std::string>());
  }
  if (!failures.empty()) text += "\nWorst failure of each candidate:\n" + failures;
  return text;
}

}  // namespace touchstone
