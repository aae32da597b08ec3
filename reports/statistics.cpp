#include "reports/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

std::optional<Quantiles> quantiles(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return Quantiles{values[(n + 1) / 2 - 1], values[(99 * n + 99) / 100 - 1], values[n - 1]};
}

std::optional<Shares> shares(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  std::vector<double> lacking;
  double sum = 0;
  for (const double v : values) {
    lacking.push_back(1 - v);
    sum += v;
  }
  const Quantiles q = *quantiles(std::move(lacking));
  return Shares{sum / static_cast<double>(values.size()), 1 - q.median, 1 - q.p99, 1 - q.max};
}

Statistics statistics(const std::vector<Score>& scores) {
  Statistics result;
  result.count = scores.size();
  std::vector<double> depth_error, normal_regret, normal_angle, point_error, deepest_error,
      coverage, model_error, solver_error, severity;
  for (const Score& s : scores) {
    ++result.outcomes[static_cast<std::size_t>(s.outcome)];
    if (is_judged(s.outcome)) severity.push_back(s.severity);
    if (s.points > 0) ++result.points[s.points];
    if (s.depth_error) depth_error.push_back(std::abs(*s.depth_error));
    if (s.normal_regret) normal_regret.push_back(*s.normal_regret);
    if (s.normal_angle) normal_angle.push_back(*s.normal_angle);
    if (s.point_error) point_error.push_back(*s.point_error);
    if (s.deepest_error) deepest_error.push_back(std::abs(*s.deepest_error));
    if (s.coverage) coverage.push_back(*s.coverage);
    if (s.model_error) model_error.push_back(std::abs(*s.model_error));
    if (s.solver_error) solver_error.push_back(std::abs(*s.solver_error));
  }
  result.coverage = shares(coverage);
  result.severity = quantiles(std::move(severity));
  if (!depth_error.empty()) result.depth_histogram = log_histogram(depth_error);
  if (!normal_regret.empty()) result.regret_histogram = log_histogram(normal_regret);
  result.depth_error = quantiles(std::move(depth_error));
  result.normal_regret = quantiles(std::move(normal_regret));
  result.normal_angle = quantiles(std::move(normal_angle));
  result.point_error = quantiles(std::move(point_error));
  result.deepest_error = quantiles(std::move(deepest_error));
  result.model_error = quantiles(std::move(model_error));
  result.solver_error = quantiles(std::move(solver_error));
  return result;
}

}  // namespace touchstone
