#include "reports/log_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace touchstone {

LogHistogram log_histogram(const std::vector<double>& values) {
  constexpr int lowest = -36, highest = 11;  // half decades
  LogHistogram result;
  std::map<int, std::size_t> bins;
  for (const double v : values) {
    if (v == 0) {
      ++result.zero;
    } else {
      ++bins[static_cast<int>(std::clamp<double>(std::floor(2 * std::log10(v)), lowest, highest))];
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
