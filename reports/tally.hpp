#pragma once

#include <array>
#include <boost/container/flat_map.hpp>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "oracle/judge/score.hpp"
#include "reports/report.hpp"
#include "reports/statistics.hpp"

namespace touchstone {

/// Is `a` the worse failure? Those without an answer are, then those of larger severity; any
/// failure is worse than agreement.
bool is_worse(const Score& a, const Score& b);

/// The score of one candidate on one configuration.
struct Case {
  std::size_t cell;     ///< pair × class, in report order
  std::uint64_t index;  ///< of the configuration in its class
  Score score;

  /// The worse one first (is_worse); equal ones in report order.
  bool operator<(const Case& other) const;
};

/// Selects from the cases of one class the two worst and the worst of each outcome, worst first.
/// Cases that a candidate does not support or was not asked are left out. The worst of two sets
/// together are the worst of the worst of each.
std::vector<Case> worst_of_class(std::vector<Case> cases);

/// Selects from what worst_of_class gave of all classes under a heading (pair × group) the worst of
/// each outcome, and what else is worst up to four, worst first.
std::vector<Case> worst_of_heading(std::vector<Case> cases);

/// How magnitudes are kept.
enum class Precision {
  exact,  ///< every value: exact quantiles; memory grows with the number of values
  binned  ///< counts of bins and the maximum: bounds of quantiles; memory stays flat
};

/// Magnitudes |value| of which quantiles are wanted. Sums of parts, added in any order, have the
/// same quantiles; binned, the same bits. A bin is an eighth of an octave wide; bins reach from
/// zero to the largest double.
class Magnitudes {
 public:
  /// Sums and percentiles do not overflow, not even of a thousand pose classes together: a coverage
  /// sum has room for 2^64 of its units, which are 1.8e13 configurations.
  static constexpr std::uint64_t max_count = 1'000'000'000;
  /// The first 15 bits of a double that is not negative (sign, exponent, three of the mantissa)
  /// number its bin.
  using Bins = boost::container::flat_map<std::uint16_t, std::uint64_t>;
  static std::uint16_t bin_of(double magnitude);

  explicit Magnitudes(Precision precision = Precision::binned) : precision_(precision) {}
  /// Binned ones that were kept elsewhere.
  Magnitudes(Bins bins, double max);

  /// What is not finite counts as the largest double.
  void add(double value);
  /// Adds magnitudes of the same precision.
  void add(const Magnitudes& other);

  Precision precision() const { return precision_; }
  std::uint64_t count() const { return count_; }
  double max() const { return max_; }
  const Bins& bins() const { return bins_; }                     ///< empty where exact
  const std::vector<double>& values() const { return values_; }  ///< empty where binned

  /// Absent without values.
  std::optional<Quantiles> quantiles() const;
  /// Bounds, at most an eighth apart, of the ⌈n·percent/100⌉-th smallest of n binned values.
  std::optional<Bounds> percentile(std::uint64_t percent) const;
  /// Bounds of the rank-th smallest value: equal ones where values are exact. Precondition: rank is
  /// from 1 to count().
  Bounds ranked(std::uint64_t rank) const;

  template <class Archive>
  friend void members(Archive& a, Magnitudes& m) {
    a(m.precision_, m.bins_, m.values_, m.count_, m.max_);
  }

 private:
  Precision precision_;
  Bins bins_;
  std::vector<double> values_;
  std::uint64_t count_ = 0;
  double max_ = 0;
};

/// Coverages (shares between 0 and 1) of which quantiles are wanted.
struct CoverageTally {
  /// Unit of `sum`: coverage is summed as an integer, for a sum of doubles depends on its order.
  static constexpr double unit = 0x1p-20;

  explicit CoverageTally(Precision precision) : uncovered(precision) {}
  void add(double coverage);
  void add(const CoverageTally& other);
  std::optional<Shares> shares() const;

  Magnitudes uncovered;        ///< binned: one minus each coverage
  std::uint64_t sum = 0;       ///< binned: of coverages, in units
  std::vector<double> values;  ///< exact: each coverage, in order
};

/// Values with a sign of which the median is wanted.
struct SignedTally {
  explicit SignedTally(Precision precision) : negative(precision), positive(precision) {}
  void add(double value);
  void add(const SignedTally& other);
  std::optional<SignedMedian> median() const;
  std::uint64_t count() const { return negative.count() + positive.count(); }

  Magnitudes negative, positive;  ///< zero is positive
};

/// The scores of one candidate on any number of configurations. Binned, it takes constant memory,
/// and everything in it is an integer, a maximum or a selection under a total order: tallies of the
/// parts, added in any order, are the tally of the whole to the last bit. Exact, only the mean
/// coverage depends on the order of adding, in its last bits.
struct ScoreTally {
  explicit ScoreTally(Precision precision = Precision::binned);

  /// Adds the score of a configuration: `index` of its cell.
  void add(std::size_t cell, std::uint64_t index, const Score& score);
  /// Adds a tally of the same precision.
  void add(const ScoreTally& other);

  Statistics statistics() const;

  /// Errors of a score, as report.json calls them; less is better.
  struct Quantity {
    const char* name;
    std::optional<double> Score::*value;
    std::optional<Quantiles> Statistics::*quantiles;
  };
  static constexpr std::array<Quantity, 7> quantities = {
      {{"depth_error", &Score::depth_error, &Statistics::depth_error},
       {"normal_regret", &Score::normal_regret, &Statistics::normal_regret},
       {"normal_angle", &Score::normal_angle, &Statistics::normal_angle},
       {"point_error", &Score::point_error, &Statistics::point_error},
       {"deepest_error", &Score::deepest_error, &Statistics::deepest_error},
       {"model_error", &Score::model_error, &Statistics::model_error},
       {"solver_error", &Score::solver_error, &Statistics::solver_error}}};

  std::uint64_t count = 0;
  OutcomeCounts outcomes{};
  std::map<int, std::uint64_t> points;
  std::vector<Magnitudes> errors;  ///< of each of the quantities
  SignedTally bias;                ///< of depth errors
  Magnitudes severity;             ///< of all that is judged, missed contacts included
  CoverageTally coverage;
  std::vector<Case> worst;  ///< of a tally of one cell: its worst_of_class
};

template <class Archive>
void members(Archive& a, SignedTally& t) {
  a(t.negative, t.positive);
}
template <class Archive>
void members(Archive& a, CoverageTally& t) {
  a(t.uncovered, t.sum, t.values);
}
template <class Archive>
void members(Archive& a, ScoreTally& t) {
  a(t.count, t.outcomes, t.points, t.errors, t.bias, t.severity, t.coverage, t.worst);
}

/// Index of the worst configuration in a tally of one cell on which the candidate disagrees.
std::optional<std::uint64_t> worst_failure(const ScoreTally& tally);

/// What an error may depend on. Absent where it has no meaning: a sphere has no tilt, apart bodies
/// have no depth.
enum class Variable {
  tilt,      ///< of the cylinder's axis from parallel or perpendicular to an axis of B, radians
  depth,     ///< true penetration, relative to the smaller size
  aspect,    ///< largest over smallest half extent, of the more extreme body
  distance,  ///< of the cylinder's centre from the origin, relative to the larger size
};
inline constexpr std::array all_variables = {Variable::tilt, Variable::depth, Variable::aspect,
                                             Variable::distance};
const char* variable_name(Variable variable);

/// Value of a variable; `signed_distance` is the true one in metres.
std::optional<double> value_of(Variable variable, const Configuration& configuration,
                               double signed_distance);

/// Severity of judged answers against each variable, by its decades. Tallies of the parts, added in
/// any order, give the trends of the whole.
class TrendTally {
 public:
  /// `scores`: of every candidate on this configuration.
  void add(const Configuration& configuration, double signed_distance,
           const std::vector<Score>& scores);
  void add(const TrendTally& other);

  /// Trends of one pair and group: of each candidate and variable with any values.
  std::vector<Trend> trends(const std::string& pair, const std::string& group,
                            const std::vector<std::string>& candidates) const;

  template <class Archive>
  friend void members(Archive& a, TrendTally& t) {
    a(t.bins_);
  }

 private:
  struct Key {
    std::size_t candidate;
    Variable variable;
    std::optional<int> decade;  ///< absent, which comes first: zero, and what is lost in rounding
    auto operator<=>(const Key&) const = default;  // NOLINT(modernize-use-nullptr): not written
  };
  struct Bin {
    std::vector<double> severity;
    std::uint64_t missed = 0;

    template <class Archive>
    friend void members(Archive& a, Bin& b) {
      a(b.severity, b.missed);
    }
  };
  std::map<Key, Bin> bins_;
};

}  // namespace touchstone
