#include "reports/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace touchstone {

double finite(double value) {
  constexpr double max = std::numeric_limits<double>::max();
  return std::isnan(value) ? max : std::clamp(value, -max, max);
}

std::uint64_t LogHistogram::count() const {
  return std::accumulate(counts.begin(), counts.end(), zero);
}

std::uint64_t LogHistogram::above(double value) const {
  const std::int64_t below = std::int64_t{half_decade(value)} + 1 - first;  // so many half decades
  const auto size = static_cast<std::int64_t>(counts.size());
  return std::accumulate(counts.begin() + std::clamp<std::int64_t>(below, 0, size), counts.end(),
                         std::uint64_t{0});
}

int half_decade(double value) {
  constexpr double min = -36, max = 11;
  return static_cast<int>(std::clamp(std::floor(2 * std::log10(value)), min, max));
}

bool tied_in_time(const SpeedAccuracy& a, const SpeedAccuracy& b) {
  return a.low <= b.high && b.low <= a.high;
}

bool beats(const SpeedAccuracy& a, const SpeedAccuracy& b) {
  const bool a_is_slower = a.low > b.high, a_is_faster = a.high < b.low;
  return a.error < b.error ? !a_is_slower : a.error == b.error && a_is_faster;
}

std::vector<bool> pareto_front(const std::vector<SpeedAccuracy>& candidates) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Whatever may beat another comes before it.
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const SpeedAccuracy &a = candidates[i], &b = candidates[j];
    return std::tie(a.error, a.high, i) < std::tie(b.error, b.high, j);
  });
  std::vector<bool> on_front(candidates.size(), false);
  for (std::size_t at = 0; at < order.size(); ++at) {
    const auto before = order.begin() + static_cast<std::ptrdiff_t>(at);
    on_front[order[at]] = std::none_of(order.begin(), before, [&](std::size_t i) {
      const SpeedAccuracy &better = candidates[i], &worse = candidates[order[at]];
      return on_front[i] && (better.is_native || !worse.is_native) && beats(better, worse);
    });
  }
  return on_front;
}

}  // namespace touchstone
