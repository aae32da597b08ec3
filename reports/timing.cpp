#include "reports/timing.hpp"

#include <algorithm>

#include "candidates/candidate_process.hpp"
#include "reports/progress.hpp"

namespace touchstone {
namespace {

constexpr std::size_t rounds = 9;
/// More configurations than this of one cell would not change its median.
constexpr std::uint64_t most_configurations = 50;

/// Those that a candidate survived, in order; all are asked of it within one process.
std::vector<Configuration> survived(const Campaign& campaign, const Cell& cell,
                                    const std::vector<Score>& scores) {
  std::vector<Configuration> result;
  for (std::uint64_t i = 0; i < std::min(campaign.count, most_configurations); ++i) {
    const Outcome outcome = scores[i].outcome;
    if (outcome == Outcome::unsupported) return {};
    if (outcome == Outcome::crashed || outcome == Outcome::timed_out) continue;
    result.push_back(make_configuration({cell.pair, cell.pose_class, campaign.seed, i}));
  }
  return result;
}

std::vector<std::optional<QueryTime>> time_cell(const Campaign& campaign, const Cell& cell,
                                                std::vector<CandidateProcess>& candidates,
                                                const CellScores& scores) {
  std::vector<bool> ready;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const auto configurations = survived(campaign, cell, scores.scores[k]);
    ready.push_back(!configurations.empty() && candidates[k].prepare_timing(configurations));
  }
  std::vector<std::vector<double>> samples(candidates.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t turn = 0; turn < candidates.size(); ++turn) {
      const std::size_t k = (round + turn) % candidates.size();
      if (!ready[k]) continue;
      if (const auto time = candidates[k].nanoseconds_per_query()) samples[k].push_back(*time);
    }
  }
  std::vector<std::optional<QueryTime>> result(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    auto& s = samples[k];
    if (s.size() < rounds) continue;  // it died in between
    std::sort(s.begin(), s.end());
    result[k] = {s[rounds / 2], s[3 * rounds / 4] - s[rounds / 4]};
  }
  return result;
}

}  // namespace

std::vector<std::vector<std::optional<QueryTime>>> time_queries(
    const Campaign& campaign, const std::vector<CellScores>& scores) {
  const std::vector<Cell> all = cells(campaign);
  Progress progress("pose classes timed", all.size());
  std::vector<std::vector<std::optional<QueryTime>>> times;
  auto candidates = start(campaign.candidates, campaign.bar.threshold, campaign.limits);
  for (std::size_t i = 0; i < all.size(); ++i) {
    times.push_back(time_cell(campaign, all[i], candidates, scores[i]));
    progress.update(times.size());
  }
  return times;
}

}  // namespace touchstone
