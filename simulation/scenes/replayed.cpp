#include "simulation/scenes/replayed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "candidates/candidates.hpp"
#include "candidates/host/progress.hpp"

namespace touchstone {
namespace {

constexpr std::size_t rounds = 9;

std::vector<Configuration> sample(const Scene& scene, const Trajectory& run, const PairKind& kind) {
  const std::size_t count = std::min(most_replayed, kind.asked.size());
  std::vector<Configuration> result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(run.configuration(scene, kind.asked[i * kind.asked.size() / count]));
  }
  return result;
}

/// Regrets below this share of the smaller size are those of a normal that is as good.
constexpr double as_good = 1e-6;

/// Metres.
double depth_error(const Score& s, double size) {
  if (s.depth_error) return std::abs(*s.depth_error) * size;
  if (s.outcome == Outcome::agree || s.outcome == Outcome::missed) return s.severity * size;
  return std::numeric_limits<double>::infinity();
}

Replayed scored(const std::vector<Configuration>& configurations,
                const std::vector<oracle::Truth>& truths, const std::vector<Answer>& answers) {
  Replayed result;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const Score s = score(configurations[i], truths[i], answers[i], Bar{});
    ++result.count;
    if (s.outcome == Outcome::agree) ++result.agree;
    const double error = depth_error(s, error_size(configurations[i], Bar{}));
    if (error > result.depth_error) result.depth_error = error, result.deepest_error = i;
    const double angle = s.normal_regret.value_or(0) > as_good ? s.normal_angle.value_or(0) : 0;
    if (angle > result.normal_angle) result.normal_angle = angle, result.widest_angle = i;
  }
  return result;
}

}  // namespace

std::vector<Replayed> replay(const std::vector<Configuration>& configurations,
                             std::vector<CandidateProcess>& candidates) {
  std::vector<oracle::Truth> truths;
  for (const Configuration& c : configurations) truths.push_back(oracle::truth(c));
  std::vector<Replayed> result(candidates.size());
  std::vector<bool> ready(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const ts_shape_kind other = to_ts_shape(configurations.front().b).kind;
    if (!candidates[k].candidate().supports[other]) continue;
    result[k] = scored(configurations, truths, candidates[k].answers(configurations));
    ready[k] = candidates[k].prepare_timing(configurations);
  }
  std::vector<std::vector<double>> times(candidates.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t turn = 0; turn < candidates.size(); ++turn) {
      const std::size_t k = (round + turn) % candidates.size();
      if (!ready[k]) continue;
      if (const auto cost = candidates[k].cost_per_query()) times[k].push_back(cost->nanoseconds);
    }
  }
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (times[k].size() < rounds) continue;  // unsupported, or it died in between
    std::nth_element(times[k].begin(), times[k].begin() + rounds / 2, times[k].end());
    result[k].nanoseconds = times[k][rounds / 2];
  }
  return result;
}

std::vector<std::vector<Replayed>> replay(const Scene& scene, const Trajectory& run,
                                          const std::vector<PairKind>& kinds,
                                          const std::vector<const Candidate*>& candidates,
                                          const Limits& limits) {
  Progress progress("kinds of pairs replayed", kinds.size());
  auto processes = start(candidates, simulation_threshold, limits);
  std::vector<std::vector<Replayed>> result;
  for (const PairKind& kind : kinds) {
    result.push_back(replay(sample(scene, run, kind), processes));
    progress.update(result.size());
  }
  return result;
}

}  // namespace touchstone
