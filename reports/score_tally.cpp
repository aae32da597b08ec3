#include "reports/score_tally.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace touchstone {
namespace {

/// JSON, which campaigns keep tallies in, knows no infinity.
double finite(double value) {
  constexpr double max = std::numeric_limits<double>::max();
  return std::isnan(value) ? max : std::clamp(value, -max, max);
}

/// What is kept of the score of one of the worst cases.
Score essence(const Score& s) {
  Score kept;
  kept.outcome = s.outcome;
  if (s.depth_error) kept.depth_error = finite(*s.depth_error);
  if (s.normal_regret) kept.normal_regret = finite(*s.normal_regret);
  kept.severity = finite(s.severity);
  return kept;
}

std::optional<LogHistogram> histogram(const Magnitudes& m) {
  if (m.values().empty()) return std::nullopt;
  return log_histogram(m.values());
}

}  // namespace

void CoverageTally::add(double coverage) {
  if (uncovered.precision() == Precision::exact) {
    values.push_back(coverage);
    return;
  }
  const double covered = std::clamp(coverage, 0.0, 1.0);
  uncovered.add(1 - covered);
  sum += static_cast<std::uint64_t>(std::llround(covered / unit));
}

void CoverageTally::add(const CoverageTally& other) {
  uncovered.add(other.uncovered);
  sum += other.sum;
  values.insert(values.end(), other.values.begin(), other.values.end());
}

std::optional<Shares> CoverageTally::shares() const {
  if (uncovered.precision() == Precision::exact) return touchstone::shares(values);
  const auto q = uncovered.quantiles();
  if (!q) return std::nullopt;
  const auto rest = [](const Bounds& b) { return Bounds{1 - b.upper, 1 - b.lower}; };
  const double mean = static_cast<double>(sum) * unit / static_cast<double>(uncovered.count());
  return Shares{mean,       1 - q->median,           1 - q->p99,
                1 - q->max, rest(*q->median_bounds), rest(*q->p99_bounds)};
}

ScoreTally::ScoreTally(Precision precision)
    : errors(quantities.size(), Magnitudes(precision)), severity(precision), coverage(precision) {}

void ScoreTally::add(std::size_t cell, std::uint64_t index, const Score& s) {
  ++count;
  ++outcomes[static_cast<std::size_t>(s.outcome)];
  if (s.points > 0) ++points[s.points];
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (const auto& error = s.*quantities[i].value) errors[i].add(*error);
  }
  if (is_judged(s.outcome)) severity.add(s.severity);
  if (s.coverage) coverage.add(*s.coverage);
  worst.push_back({cell, index, essence(s)});
  worst = worst_of_class(std::move(worst));
}

void ScoreTally::add(const ScoreTally& other) {
  count += other.count;
  for (std::size_t i = 0; i < outcomes.size(); ++i) outcomes[i] += other.outcomes[i];
  for (const auto& [number, times] : other.points) points[number] += times;
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i].add(other.errors[i]);
  severity.add(other.severity);
  coverage.add(other.coverage);
  worst.insert(worst.end(), other.worst.begin(), other.worst.end());
  worst = worst_of_class(std::move(worst));
}

Statistics ScoreTally::statistics() const {
  Statistics result;
  result.count = count;
  result.outcomes = outcomes;
  result.points = points;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    result.*quantities[i].quantiles = errors[i].quantiles();
  }
  result.depth_histogram = histogram(errors[0]);
  result.regret_histogram = histogram(errors[1]);
  result.severity = severity.quantiles();
  result.coverage = coverage.shares();
  return result;
}

}  // namespace touchstone
