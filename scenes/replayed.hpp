#pragma once

#include <optional>
#include <vector>

#include "reports/score.hpp"
#include "scenes/pair_kind.hpp"

namespace touchstone {

/// One candidate on the configurations of one kind of pairs that really occurred.
struct Replayed {
  std::optional<double> nanoseconds;  ///< of a query, median of the rounds; absent: unsupported
  std::size_t count = 0, agree = 0;   ///< configurations, and those on which it agrees
  double depth_error = 0;             ///< largest, relative to the smaller size
};

/// Up to this many configurations of a kind, evenly over the run, stand for all.
inline constexpr std::size_t most_replayed = 64;

/// replayed[kind][candidate]: scored against the oracle, and timed in turns, one process at a time.
std::vector<std::vector<Replayed>> replay(const Scene& scene, const Trajectory& run,
                                          const std::vector<PairKind>& kinds,
                                          const std::vector<const Candidate*>& candidates,
                                          const Limits& limits);

}  // namespace touchstone
