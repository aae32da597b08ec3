#include "reports/make_report.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <system_error>

#include "candidates/host/interruption.hpp"
#include "properties/files/write_file.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"
#include "reports/drake_protocol.hpp"
#include "reports/html/html.hpp"
#include "reports/machine.hpp"
#include "reports/pareto.hpp"
#include "reports/report_file.hpp"
#include "reports/statistics.hpp"
#include "reports/timing.hpp"
#include "reports/trends.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json to_json(const std::optional<Quantiles>& q) {
  if (!q) return nullptr;
  return {{"median", q->median}, {"p99", q->p99}, {"max", q->max}};
}

json to_json(const std::optional<Quantiles>& q, const LogHistogram& h) {
  json result = to_json(q);
  if (q) result["histogram"] = {{"zero", h.zero}, {"first", h.first}, {"counts", h.counts}};
  return result;
}

json to_json(const std::optional<Shares>& s) {
  if (!s) return nullptr;
  return {{"mean", s->mean}, {"median", s->median}, {"p1", s->p1}, {"min", s->min}};
}

json to_json(const Statistics& s) {
  json outcomes = json::object(), points = json::object();
  for (const Outcome outcome : all_outcomes) {
    if (s.of(outcome) > 0) outcomes[outcome_name(outcome)] = s.of(outcome);
  }
  for (const auto& [number, count] : s.points) points[std::to_string(number)] = count;
  return {{"count", s.count},
          {"outcomes", outcomes},
          {"severity", to_json(s.severity)},
          {"depth_error", to_json(s.depth_error, s.depth_histogram)},
          {"normal_regret", to_json(s.normal_regret, s.regret_histogram)},
          {"normal_angle", to_json(s.normal_angle)},
          {"point_error", to_json(s.point_error)},
          {"deepest_error", to_json(s.deepest_error)},
          {"model_error", to_json(s.model_error)},
          {"solver_error", to_json(s.solver_error)},
          {"points", points},
          {"coverage", to_json(s.coverage)}};
}

/// The same scores and times under one heading: a cell, all of a pair, everything.
struct Group {
  std::vector<std::size_t> cells;
  std::string pair, pose_class;
};

json time_json(const Campaign& campaign, const Times& times, const Group& group, std::size_t k) {
  const auto time = query_time(times, group.cells, k);
  if (!time) return nullptr;
  const auto& [median, low, high] = time->nanoseconds;
  json result = {{"median", median},
                 {"low", low},
                 {"high", high},
                 {"spread", high - low},
                 {"repetitions", timing_repetitions},
                 {"instructions", nullptr},
                 {"ratio_to_bullet", nullptr},
                 {"ratio_low", nullptr},
                 {"ratio_high", nullptr}};
  if (time->instructions) result["instructions"] = *time->instructions;
  for (std::size_t b = 0; b < campaign.candidates.size(); ++b) {
    if (campaign.candidates[b]->name != "bullet") continue;
    if (const auto ratio = time_ratio(times, group.cells, k, b)) {
      result["ratio_to_bullet"] = ratio->median;
      result["ratio_low"] = ratio->low;
      result["ratio_high"] = ratio->high;
    }
  }
  return result;
}

json entry(const Campaign& campaign, const std::vector<CellScores>& scores, const Times& times,
           const Group& group, std::size_t k) {
  std::vector<Score> all;
  for (const std::size_t cell : group.cells) {
    all.insert(all.end(), scores[cell].scores[k].begin(), scores[cell].scores[k].end());
  }
  json result = to_json(statistics(all));
  result["pair"] = group.pair;
  result["class"] = group.pose_class;
  result["candidate"] = campaign.candidates[k]->name;
  result["nanoseconds"] = time_json(campaign, times, group, k);
  return result;
}

json entries(const Campaign& campaign, const std::vector<CellScores>& scores, const Times& times,
             const std::vector<Group>& groups) {
  json result = json::array();
  for (const Group& group : groups) {
    for (std::size_t k = 0; k < campaign.candidates.size(); ++k) {
      result.push_back(entry(campaign, scores, times, group, k));
    }
  }
  return result;
}

/// Adds to the rows of one group of candidates which are on the front of speed and accuracy, and
/// whose times tie.
void rank(json& rows, std::size_t first, std::size_t count) {
  /// Half an ulp of the size or less: no difference in accuracy.
  constexpr double no_error = 1e-17;
  std::vector<std::size_t> placed;
  std::vector<SpeedAccuracy> places;
  for (std::size_t i = first; i < first + count; ++i) {
    json& row = rows[i];
    row["pareto"] = nullptr;
    row["tied_with"] = json::array();
    const json &time = row["nanoseconds"], &error = row["depth_error"];
    if (time.is_null() || error.is_null()) continue;
    placed.push_back(i);
    places.push_back({time["low"], time["high"], std::max(error["p99"].get<double>(), no_error)});
  }
  const std::vector<bool> front = pareto_front(places);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    rows[placed[i]]["pareto"] = static_cast<bool>(front[i]);
    for (std::size_t k = 0; k < placed.size(); ++k) {
      if (k == i || !tied_in_time(places[i], places[k])) continue;
      rows[placed[i]]["tied_with"].push_back(rows[placed[k]]["candidate"]);
    }
  }
}

}  // namespace

json make_report(const Campaign& campaign, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Cell> all = cells(campaign);
  const std::vector<CellScores> scores = run(campaign);
  const Times times = time_queries(campaign, scores);
  const bool partial = interrupted();

  std::vector<Group> single, summary;
  Group everything{{}, "all", "all"};
  json classes = json::array();
  std::size_t timed = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!scores[i].done()) continue;
    const auto has_times = [](const Repetitions& r) { return !r.empty(); };
    timed += std::any_of(times[i].begin(), times[i].end(), has_times);
    const char* pair = pair_name(all[i].pair);
    single.push_back({{i}, pair, all[i].pose_class});
    if (summary.empty() || summary.back().pair != pair) summary.push_back({{}, pair, "all"});
    summary.back().cells.push_back(i);
    everything.cells.push_back(i);
    classes.push_back({{"pair", pair},
                       {"class", all[i].pose_class},
                       {"description", describe_pose_class(all[i].pair, all[i].pose_class)}});
  }
  if (summary.size() > 1) summary.push_back(everything);

  json candidates = json::array();
  for (const Candidate* c : campaign.candidates) {
    candidates.push_back({{"name", c->name},
                          {"family", c->family},
                          {"version", c->version},
                          {"settings", c->settings},
                          {"models", c->models}});
  }
  std::vector<double> oracle_times;
  for (const CellScores& s : scores) {
    oracle_times.insert(oracle_times.end(), s.oracle_microseconds.begin(),
                        s.oracle_microseconds.end());
  }
  json rows = entries(campaign, scores, times, summary);
  for (std::size_t i = 0; i < rows.size(); i += campaign.candidates.size()) {
    rank(rows, i, campaign.candidates.size());
  }
  const json worst = worst_cases(campaign, scores);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {{"schema", report_schema},
          {"version", TOUCHSTONE_VERSION},
          {"command", command},
          {"seed", campaign.seed},
          {"tolerance", campaign.bar.tolerance},
          {"threshold", campaign.bar.threshold},
          {"machine", describe_machine()},
          {"configurations", single.size() * campaign.count},
          {"partial", partial},
          {"planned", {{"classes", all.size()}, {"configurations", all.size() * campaign.count}}},
          {"completed",
           {{"classes", single.size()},
            {"configurations", single.size() * campaign.count},
            {"timed_classes", timed}}},
          {"wall_seconds", seconds},
          {"oracle_microseconds", to_json(quantiles(oracle_times))},
          {"candidates", candidates},
          {"classes", classes},
          {"results", entries(campaign, scores, times, single)},
          {"summary", rows},
          {"trends", trends(campaign, scores)},
          {"drake_protocol", partial ? json(nullptr) : drake_protocol(campaign)},
          {"worst", worst}};
}

void write_report(const json& report, const std::filesystem::path& folder) {
  check_writable(folder);
  write_file(folder / "report.json", report.dump(1) + "\n", "--out");
  write_file(folder / "report.html", render_html(report), "--out");
}

}  // namespace touchstone
