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

LogHistogram log_histogram(const std::vector<double>& values) {
  constexpr int min_bin = -36, max_bin = 11;  // half decades
  LogHistogram result;
  std::map<int, std::uint64_t> bins;
  for (const double v : values) {
    if (v == 0) {
      ++result.zero;
    } else {
      ++bins[static_cast<int>(std::clamp<double>(std::floor(2 * std::log10(v)), min_bin, max_bin))];
    }
  }
  if (bins.empty()) return result;
  result.first = bins.begin()->first;
  result.counts.resize(static_cast<std::size_t>(bins.rbegin()->first - result.first) + 1);
  for (const auto& [bin, count] : bins) {
    result.counts[static_cast<std::size_t>(bin - result.first)] = count;
  }
  return result;
}

}  // namespace touchstone
