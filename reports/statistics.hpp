#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "oracle/judge/score.hpp"
#include "reports/log_histogram.hpp"

namespace touchstone {

/// Nearest-rank quantiles: the median of n values is the ⌈n/2⌉-th smallest, p99 the ⌈0.99 n⌉-th.
struct Quantiles {
  double median, p99, max;
};
std::optional<Quantiles> quantiles(std::vector<double> values);

/// Shares of which more is better: the 1st percentile is that of which 99% are no less.
struct Shares {
  double mean, median, p1, min;
};
std::optional<Shares> shares(const std::vector<double>& values);

/// Scores of one candidate on any set of configurations.
struct Statistics {
  std::size_t count = 0;
  std::array<std::size_t, all_outcomes.size()> outcomes{};  ///< in the order of all_outcomes
  std::map<int, std::size_t> points;                        ///< contacts by their number of points
  std::optional<Quantiles> depth_error, normal_regret, normal_angle, point_error, deepest_error,
      model_error, solver_error;                   ///< of magnitudes
  std::optional<Quantiles> severity;               ///< of all that is judged, missed ones included
  LogHistogram depth_histogram, regret_histogram;  ///< of what depth_error, normal_regret hold
  std::optional<Shares> coverage;

  std::size_t of(Outcome outcome) const { return outcomes[static_cast<std::size_t>(outcome)]; }
};
Statistics statistics(const std::vector<Score>& scores);

}  // namespace touchstone
