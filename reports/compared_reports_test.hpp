#pragma once

#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reports/compare.hpp"
#include "reports/report_json.hpp"

namespace touchstone {

// Reports as small as a test of comparisons wants them, and what it reads of one.

/// A row with an agreement of `agree` in 100, a 99th percentile of `error`, a time of `time` ns
/// give or take 1% and Bullet at 100 ns.
inline nlohmann::json row(const char* pose_class, const char* candidate, int agree, double error,
                          double time) {
  const nlohmann::json errors = {{"median", error / 10}, {"p99", error}, {"max", 2 * error}};
  return {{"pair", "cylinder-box"},
          {"class", pose_class},
          {"candidate", candidate},
          {"count", 100},
          {"outcomes", {{"agree", agree}, {"shallow", 100 - agree}}},
          {"depth_error", errors},
          {"normal_regret", nullptr},
          {"point_error", nullptr},
          {"coverage", {{"mean", 0.5}}},
          {"pareto", true},
          {"nanoseconds",
           {{"median", time},
            {"low", 0.99 * time},
            {"high", 1.01 * time},
            {"instructions", nullptr},
            {"ratio_to_bullet", time / 100},
            {"ratio_low", 0.99 * time / 100},
            {"ratio_high", 1.01 * time / 100}}}};
}

/// Of two classes and two candidates.
inline nlohmann::json report_of_rows() {
  return {{"schema", report_schema},
          {"version", "0.1.0"},
          {"seed", 1},
          {"tolerance", 1e-4},
          {"threshold", 0.0},
          {"configurations", 200},
          {"partial", false},
          {"machine", {{"cpu", "one"}, {"compiler", "g++"}}},
          {"candidates",
           {{{"name", "bullet"}, {"version", "3.24"}, {"settings", "as it is"}},
            {{"name", "mine"}, {"version", "1"}, {"settings", "as it is"}}}},
          {"results",
           {row("rim-face", "bullet", 90, 1e-3, 100), row("rim-face", "mine", 80, 1e-6, 200),
            row("touching", "bullet", 90, 1e-3, 100), row("touching", "mine", 80, 1e-6, 200)}},
          {"summary",
           {row("everyday", "bullet", 90, 1e-3, 100), row("everyday", "mine", 80, 1e-6, 200)}}};
}

/// Compares them as they are, but for the sum of all classes.
inline Comparison compare(const nlohmann::json& before, const nlohmann::json& after,
                          const CompareLimits& limits) {
  const auto read = [](nlohmann::json report) {
    std::map<std::string, std::uint64_t> counts;
    for (const nlohmann::json& row : report["results"]) {
      counts[row["pair"].get<std::string>() + '/' + row["class"].get<std::string>()] = row["count"];
    }
    report["configurations"] = 0;
    for (const auto& [name, count] : counts) {
      report["configurations"] = report["configurations"].get<std::uint64_t>() + count;
    }
    return report_from_text(report.dump(), "report");
  };
  return touchstone::compare(read(before), read(after), limits);
}

/// Lists the changes beyond the limits.
inline std::vector<std::string> changes(const Comparison& comparison) {
  std::vector<std::string> result;
  for (const Change& c : comparison.changes) {
    if (!c.beyond_limits) continue;
    std::ostringstream text;
    text << verdict_name(c.verdict) << ' ' << c.pose_class << ' ' << c.candidate << ' '
         << c.measure;
    result.push_back(text.str());
  }
  return result;
}

inline std::string remarks(const Comparison& comparison) {
  std::string text;
  for (const std::string& remark : comparison.remarks) text += remark + '\n';
  return text;
}

}  // namespace touchstone
