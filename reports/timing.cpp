#include "reports/timing.hpp"

#include <algorithm>
#include <chrono>

#include "candidates/candidates.hpp"
#include "reports/progress.hpp"

namespace touchstone {
namespace {

constexpr std::size_t rounds = 9;
/// More configurations than this of one cell would not change its median.
constexpr std::uint64_t most_configurations = 200;

struct Query {
  PreparedPair pair;
  ts_pose a, b;
};

double nanoseconds_per_query(const std::vector<Query>& queries) {
  const auto start = std::chrono::steady_clock::now();
  // The call goes through a function pointer, which no optimiser removes.
  for (const Query& q : queries) q.pair.query(q.a, q.b);
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::nano>(end - start).count() /
         static_cast<double>(queries.size());
}

std::vector<std::optional<QueryTime>> time_cell(const Campaign& campaign, const Cell& cell) {
  const std::size_t candidates = campaign.candidates.size();
  std::vector<std::vector<Query>> queries(candidates);
  for (std::uint64_t i = 0; i < std::min(campaign.count, most_configurations); ++i) {
    const Configuration c = make_configuration({cell.pair, cell.pose_class, campaign.seed, i});
    for (std::size_t k = 0; k < candidates; ++k) {
      const ts_candidate& candidate = *campaign.candidates[k];
      if (!candidate.supports(to_ts_shape(c.b).kind)) continue;
      queries[k].push_back({PreparedPair(candidate, c.a, c.b, campaign.bar.threshold),
                            to_ts_pose(c.pose_a), to_ts_pose(c.pose_b)});
    }
  }
  std::vector<std::vector<double>> samples(candidates);
  for (std::size_t round = 0; round <= rounds; ++round) {
    for (std::size_t turn = 0; turn < candidates; ++turn) {
      const std::size_t k = (round + turn) % candidates;
      if (queries[k].empty()) continue;
      const double time = nanoseconds_per_query(queries[k]);
      if (round > 0) samples[k].push_back(time);  // the first round warms up
    }
  }
  std::vector<std::optional<QueryTime>> result(candidates);
  for (std::size_t k = 0; k < candidates; ++k) {
    auto& s = samples[k];
    if (s.empty()) continue;
    std::sort(s.begin(), s.end());
    result[k] = {s[rounds / 2], s[3 * rounds / 4] - s[rounds / 4]};
  }
  return result;
}

}  // namespace

std::vector<std::vector<std::optional<QueryTime>>> time_queries(const Campaign& campaign) {
  const std::vector<Cell> all = cells(campaign);
  Progress progress("pose classes timed", all.size());
  std::vector<std::vector<std::optional<QueryTime>>> times;
  for (const Cell& cell : all) {
    times.push_back(time_cell(campaign, cell));
    progress.update(times.size());
  }
  return times;
}

}  // namespace touchstone
