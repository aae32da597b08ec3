#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "oracle/judge/score.hpp"

namespace touchstone {

/// The value, but the largest double with its sign for an infinity, and that for what is no number:
/// JSON, which reports and campaigns are kept in, knows neither.
double finite(double value);

/// Bounds of a binned value: lower <= value <= upper.
struct Bounds {
  double lower, upper;
};

/// Nearest-rank quantiles: the median of n values is the ⌈n/2⌉-th smallest, p99 the ⌈0.99 n⌉-th. Of
/// binned values both are the larger end of their bounds.
struct Quantiles {
  double median, p99, max;
  std::optional<Bounds> median_bounds = {}, p99_bounds = {};  ///< of binned values
};

/// Shares whose larger values are better: 99% are at least the 1st percentile. Median and
/// percentile of binned values are the smaller end of their bounds.
struct Shares {
  double mean, median, p1, min;
  std::optional<Bounds> median_bounds = {}, p1_bounds = {};  ///< of binned values
};

/// Median of values that have a sign, by nearest rank; of binned values the end of its bounds that
/// is farther from zero.
struct SignedMedian {
  double value;
  std::optional<Bounds> bounds = {};  ///< of binned values
};

/// How many magnitudes lie in each half decade: counts[i] in [10^(k/2), 10^((k+1)/2)) with
/// k = first + i. Zeros, which have no logarithm, apart. What is beyond 1e-18 or 1e6 is counted in
/// the outermost half decades.
struct LogHistogram {
  std::uint64_t zero = 0;
  int first = 0;
  std::vector<std::uint64_t> counts;  ///< empty or without zeros at its ends

  std::uint64_t count() const;
  /// Those in half decades above that of `value`, which is positive.
  std::uint64_t above(double value) const;
  bool operator==(const LogHistogram&) const = default;
};

/// k of the half decade that a positive magnitude is counted in.
int half_decade(double value);

using OutcomeCounts = std::array<std::uint64_t, all_outcomes.size()>;  ///< in the order of these

/// Summary of the scores of one candidate on any set of configurations (tally.hpp).
struct Statistics {
  std::uint64_t count = 0;
  OutcomeCounts outcomes{};
  std::map<int, std::uint64_t> points;  ///< contacts by their number of points
  std::optional<Quantiles> depth_error, normal_regret, normal_angle, point_error, deepest_error,
      model_error, solver_error;  ///< of magnitudes
  /// Median of the signed depth error: negative where a candidate is too deep.
  std::optional<SignedMedian> bias;
  std::optional<Quantiles> severity;  ///< of all that is judged, missed contacts included
  /// Histograms of depth_error and normal_regret; absent where those are, and of binned values.
  std::optional<LogHistogram> depth_histogram, regret_histogram;
  std::optional<Shares> coverage;

  std::uint64_t of(Outcome outcome) const { return outcomes[static_cast<std::size_t>(outcome)]; }
  /// Configurations that the candidate has a routine for, and those of them that it was asked.
  std::uint64_t supported() const { return count - of(Outcome::unsupported); }
  std::uint64_t asked() const { return supported() - of(Outcome::not_asked); }
  /// Was the candidate stopped in some class after time-outs (answers_until_stopped)?
  bool is_stopped() const { return of(Outcome::not_asked) > 0; }
  /// On how many of those asked it agrees.
  std::uint64_t agreeing() const {
    std::uint64_t sum = 0;
    for (const Outcome outcome : all_outcomes) {
      if (agrees(outcome)) sum += of(outcome);
    }
    return sum;
  }
  /// Share of those supported on which it agrees: at least this where it was stopped, for what it
  /// was not asked counts against it. Precondition: some are supported.
  double agreement() const {
    return static_cast<double>(agreeing()) / static_cast<double>(supported());
  }
};

/// A candidate's place in the chart of speed and accuracy.
struct SpeedAccuracy {
  double low, high;  ///< spread of its time per query
  double error;
  bool is_native = true;
};

/// Tells whether the spreads overlap: neither may be called the faster one.
bool tied_in_time(const SpeedAccuracy& a, const SpeedAccuracy& b);

/// Tells whether `a` is better: more accurate and not slower beyond the spreads, or as accurate and
/// faster beyond them.
bool beats(const SpeedAccuracy& a, const SpeedAccuracy& b);

/// Finds the candidates on the Pareto front: those that no candidate on the front beats; a native
/// one must be beaten by a native one, as the time of others tells as much of their binding. Ties
/// are not transitive (a chain of overlapping spreads may join a fast candidate and a slow one), so
/// a candidate off the front beats nobody: the front is built in the order of accuracy, and every
/// candidate off it is beaten by one on it.
std::vector<bool> pareto_front(const std::vector<SpeedAccuracy>& candidates);

}  // namespace touchstone
