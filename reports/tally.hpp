#pragma once

#include <array>
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

/// How finely magnitudes are kept.
enum class Resolution {
  exact,    ///< as they are: exact quantiles; memory grows with the number of values
  eighths,  ///< by eighths of an octave: bounds of quantiles; memory stays flat
};

/// How often each magnitude |value| occurs, at the resolution; gives their quantiles.
/// Everything in it is a count or a maximum: sums of parts, added in any order, are the same to the
/// last bit.
class Magnitudes {
 public:
  /// Sums and percentiles do not overflow, not even of a thousand pose classes together: a coverage
  /// sum has room for 2^64 of its units, which are 1.8e13 configurations.
  static constexpr std::uint64_t max_count = 1'000'000'000;

  /// A value, rounded down to the resolution, and how often it occurs.
  struct Entry {
    double value;
    std::uint64_t times;
  };

  explicit Magnitudes(Resolution resolution = Resolution::eighths) : resolution_(resolution) {}

  /// What is not finite counts as the largest double.
  void add(double value);
  /// Adds magnitudes of the same resolution.
  void add(const Magnitudes& other);

  bool is_exact() const { return resolution_ == Resolution::exact; }
  std::uint64_t count() const;
  const std::vector<Entry>& entries() const { return entries_; }  ///< in ascending order

  /// Absent without values.
  std::optional<Quantiles> quantiles() const;
  /// Bounds of the rank-th smallest value, at most an eighth apart; equal ones where values are
  /// exact. Precondition: rank is from 1 to count().
  Bounds ranked(std::uint64_t rank) const;
  /// Absent without values, and of values that are not exact.
  std::optional<LogHistogram> half_decades() const;

  template <class Archive>
  friend void members(Archive& a, Magnitudes& m) {
    a(m.resolution_, m.entries_, m.max_);
  }

 private:
  Resolution resolution_;
  std::vector<Entry> entries_;
  double max_ = 0;
};

/// How often each coverage (0 to 1) occurs; gives their quantiles.
struct CoverageTally {
  /// Unit of `sum`: coverage is summed as an integer, for a sum of doubles depends on its order.
  static constexpr double unit = 0x1p-20;

  void add(double coverage);
  void add(const CoverageTally& other);
  std::optional<Shares> shares() const;

  Magnitudes uncovered;   ///< one minus each coverage
  std::uint64_t sum = 0;  ///< of coverages, in units
};

/// Signed values, whose median is wanted beside their magnitudes' quantiles.
struct SignedTally {
  void add(double value);
  void add(const SignedTally& other);
  std::optional<SignedMedian> median() const;
  Magnitudes magnitudes() const;

  Magnitudes negative, positive;  ///< zero is positive
};

/// The scores of one candidate on any number of configurations. Everything in it is an integer, a
/// maximum or a selection under a total order: tallies of the parts, added in any order, are the
/// tally of the whole to the last bit.
struct ScoreTally {
  explicit ScoreTally(Resolution resolution = Resolution::eighths);

  /// Adds the score of a configuration: `index` of its cell.
  void add(std::size_t cell, std::uint64_t index, const Score& score);
  /// Adds a tally of the same resolution.
  void add(const ScoreTally& other);

  Statistics statistics() const;

  /// Errors of a score beside that of the depth; less is better.
  struct Quantity {
    std::optional<double> Score::*value;
    std::optional<Quantiles> Statistics::*quantiles;
  };
  static constexpr std::array<Quantity, 6> quantities = {
      {{&Score::normal_regret, &Statistics::normal_regret},
       {&Score::normal_angle, &Statistics::normal_angle},
       {&Score::point_error, &Statistics::point_error},
       {&Score::deepest_error, &Statistics::deepest_error},
       {&Score::model_error, &Statistics::model_error},
       {&Score::solver_error, &Statistics::solver_error}}};

  std::uint64_t count = 0;
  OutcomeCounts outcomes{};
  std::map<int, std::uint64_t> points;
  SignedTally depth_error;
  std::array<Magnitudes, quantities.size()> errors;
  Magnitudes severity;  ///< of all that is judged, missed contacts included
  CoverageTally coverage;
  std::vector<Case> worst;  ///< of a tally of one cell: its worst_of_class
};

/// Adds up part(first) … part(last − 1), in their order; halves first, so that no value is copied
/// often.
template <class PartOf>
auto sum_of(std::size_t first, std::size_t last, const PartOf& part) {
  if (last - first == 1) return part(first);
  const std::size_t middle = first + (last - first) / 2;
  auto sum = sum_of(first, middle, part);
  sum.add(sum_of(middle, last, part));
  return sum;
}

/// What is kept of the worst cases.
template <class Archive>
void members(Archive& a, Case& c) {
  Score& s = c.score;
  a(c.cell, c.index, s.outcome, s.depth_error, s.normal_regret, s.severity);
}
template <class Archive>
void members(Archive& a, ScoreTally& t) {
  a(t.count, t.outcomes, t.points, t.depth_error, t.errors, t.severity, t.coverage, t.worst);
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
    Magnitudes severity{Resolution::exact};
    std::uint64_t missed = 0;
  };
  std::map<Key, Bin> bins_;
};

}  // namespace touchstone
