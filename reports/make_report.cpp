#include "reports/make_report.hpp"

#include <algorithm>
#include <chrono>
#include <span>

#include "candidates/host/interruption.hpp"
#include "properties/identity.hpp"
#include "reports/drake_protocol.hpp"
#include "reports/machine.hpp"
#include "reports/pareto.hpp"
#include "reports/statistics.hpp"
#include "reports/timing.hpp"
#include "reports/trends.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

/// The same scores and times under one heading: a cell, all of a pair, everything.
struct Group {
  std::vector<std::size_t> cells;
  std::string pair, pose_class;
};

std::optional<QueryTime> time_of(const Campaign& campaign, const Times& times, const Group& group,
                                 std::size_t k) {
  auto time = query_time(times, group.cells, k);
  for (std::size_t b = 0; time && b < campaign.candidates.size(); ++b) {
    if (campaign.candidates[b]->name != "bullet") continue;
    time->ratio_to_bullet = time_ratio(times, group.cells, k, b);
  }
  return time;
}

ResultRow row_of(const Campaign& campaign, const std::vector<CellScores>& scores,
                 const Times& times, const Group& group, std::size_t k) {
  std::vector<Score> all;
  for (const std::size_t cell : group.cells) {
    all.insert(all.end(), scores[cell].scores[k].begin(), scores[cell].scores[k].end());
  }
  ResultRow row;
  row.pair = group.pair;
  row.pose_class = group.pose_class;
  row.candidate = campaign.candidates[k]->name;
  row.statistics = statistics(all);
  row.time = time_of(campaign, times, group, k);
  return row;
}

std::vector<ResultRow> rows_of(const Campaign& campaign, const std::vector<CellScores>& scores,
                               const Times& times, const std::vector<Group>& groups) {
  std::vector<ResultRow> rows;
  for (const Group& group : groups) {
    for (std::size_t k = 0; k < campaign.candidates.size(); ++k) {
      rows.push_back(row_of(campaign, scores, times, group, k));
    }
  }
  return rows;
}

/// Finds which rows of one group of candidates are on the front of speed and accuracy, and whose
/// times tie.
void rank(std::span<ResultRow> rows) {
  /// Half an ulp of the size or less: no difference in accuracy.
  constexpr double no_error = 1e-17;
  std::vector<ResultRow*> placed;
  std::vector<SpeedAccuracy> places;
  for (ResultRow& row : rows) {
    const std::optional<QueryTime>& time = row.time;
    const std::optional<Quantiles>& error = row.statistics.depth_error;
    if (!time || !error) continue;
    placed.push_back(&row);
    places.push_back(
        {time->nanoseconds.low, time->nanoseconds.high, std::max(error->p99, no_error)});
  }
  const std::vector<bool> front = pareto_front(places);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i]->pareto = front[i];
    for (std::size_t k = 0; k < placed.size(); ++k) {
      if (k == i || !tied_in_time(places[i], places[k])) continue;
      placed[i]->tied_with.push_back(placed[k]->candidate);
    }
  }
}

}  // namespace

Report make_report(const Campaign& campaign, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Cell> all = cells(campaign);
  const std::vector<CellScores> scores = run(campaign);
  const Times times = time_queries(campaign, scores);

  Report report;
  report.version = TOUCHSTONE_VERSION;
  report.command = command;
  report.seed = campaign.seed;
  report.tolerance = campaign.bar.tolerance;
  report.threshold = campaign.bar.threshold;
  report.machine = describe_machine();
  report.partial = interrupted();
  for (const Candidate* c : campaign.candidates) {
    report.candidates.push_back({c->name, c->family, c->version, c->settings, c->models});
  }

  std::vector<Group> single, summary;
  Group everything{{}, "all", "all"};
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!scores[i].done()) continue;
    const auto has_times = [](const Repetitions& r) { return !r.empty(); };
    report.timed_classes += std::any_of(times[i].begin(), times[i].end(), has_times);
    const char* pair = pair_name(all[i].pair);
    single.push_back({{i}, pair, all[i].pose_class});
    if (summary.empty() || summary.back().pair != pair) summary.push_back({{}, pair, "all"});
    summary.back().cells.push_back(i);
    everything.cells.push_back(i);
    report.classes.push_back({pair, all[i].pose_class,
                              std::string(describe_pose_class(all[i].pair, all[i].pose_class))});
  }
  if (summary.size() > 1) summary.push_back(everything);
  report.planned = {all.size(), all.size() * campaign.count};
  report.completed = {single.size(), single.size() * campaign.count};
  report.configurations = report.completed.configurations;

  std::vector<double> oracle_times;
  for (const CellScores& s : scores) {
    oracle_times.insert(oracle_times.end(), s.oracle_microseconds.begin(),
                        s.oracle_microseconds.end());
  }
  report.oracle_microseconds = quantiles(std::move(oracle_times));
  report.results = rows_of(campaign, scores, times, single);
  report.summary = rows_of(campaign, scores, times, summary);
  for (std::size_t i = 0; i < report.summary.size(); i += campaign.candidates.size()) {
    rank(std::span(report.summary).subspan(i, campaign.candidates.size()));
  }
  report.trends = trends(campaign, scores);
  if (!report.partial) report.drake_protocol = drake_protocol(campaign);
  report.worst = worst_cases(campaign, scores);
  report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace touchstone
