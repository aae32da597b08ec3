#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "oracle/judge/score.hpp"

namespace touchstone {

/// What is known of a value of which only the bin was kept: lower <= value <= upper.
struct Bounds {
  double lower, upper;
};

/// Nearest-rank quantiles: the median of n values is the ⌈n/2⌉-th smallest, p99 the ⌈0.99 n⌉-th. Of
/// binned values both are the larger end of their bounds.
struct Quantiles {
  double median, p99, max;
  std::optional<Bounds> median_bounds = {}, p99_bounds = {};  ///< of binned values
};
std::optional<Quantiles> quantiles(std::vector<double> values);

/// Shares of which more is better: the 1st percentile is that of which 99% are no less. Of binned
/// values, median and percentile are the smaller end of their bounds.
struct Shares {
  double mean, median, p1, min;
  std::optional<Bounds> median_bounds = {}, p1_bounds = {};  ///< of binned values
};
std::optional<Shares> shares(const std::vector<double>& values);

/// How many magnitudes lie in each half decade: counts[i] in [10^(k/2), 10^((k+1)/2)) with
/// k = first + i. Zeros, which have no logarithm, apart. What is beyond 1e-18 or 1e6 is counted in
/// the outermost half decades.
struct LogHistogram {
  std::uint64_t zero = 0;
  int first = 0;
  std::vector<std::uint64_t> counts;  ///< empty or without zeros at its ends

  bool operator==(const LogHistogram&) const = default;
};
/// Histogram of finite values that are not negative.
LogHistogram log_histogram(const std::vector<double>& values);

/// Summary of the scores of one candidate on any set of configurations (score_tally.hpp).
struct Statistics {
  std::uint64_t count = 0;
  std::array<std::uint64_t, all_outcomes.size()> outcomes{};  ///< in the order of all_outcomes
  std::map<int, std::uint64_t> points;  ///< contacts by their number of points
  std::optional<Quantiles> depth_error, normal_regret, normal_angle, point_error, deepest_error,
      model_error, solver_error;      ///< of magnitudes
  std::optional<Quantiles> severity;  ///< of all that is judged, missed contacts included
  /// Of what depth_error and normal_regret hold; absent where those are, and of binned values.
  std::optional<LogHistogram> depth_histogram, regret_histogram;
  std::optional<Shares> coverage;

  std::uint64_t of(Outcome outcome) const { return outcomes[static_cast<std::size_t>(outcome)]; }
};

}  // namespace touchstone
