#pragma once

#include <optional>
#include <vector>

#include "oracle/judge/score.hpp"
#include "simulation/scenes/pair_kind.hpp"

namespace touchstone {

/// One candidate on configurations of one kind of pairs.
struct Replayed {
  std::optional<double> nanoseconds;  ///< of a query, median of the rounds; absent: unsupported
  std::size_t count = 0, agree = 0;   ///< configurations, and those on which it agrees
  /// Largest in size, metres; of a missed contact, its depth; infinite where there is no answer.
  double depth_error = 0;
  /// Largest, degrees, where the answered normal does not separate the bodies as well.
  double normal_angle = 0;
  std::size_t deepest_error = 0, widest_angle = 0;  ///< on which configurations
};

/// Scored against the oracle, and timed in turns, one process at a time: by candidate. All
/// configurations are of the same shapes.
std::vector<Replayed> replay(const std::vector<Configuration>& configurations,
                             std::vector<CandidateProcess>& candidates);

/// Up to this many configurations of a kind, evenly over the run, stand for all.
inline constexpr std::size_t most_replayed = 64;

/// replayed[kind][candidate], on what really occurred.
std::vector<std::vector<Replayed>> replay(const Scene& scene, const Trajectory& run,
                                          const std::vector<PairKind>& kinds,
                                          const std::vector<const Candidate*>& candidates,
                                          const Limits& limits);

}  // namespace touchstone
