#pragma once

#include <cstddef>
#include <vector>

namespace touchstone {

/// How many magnitudes lie in each half decade: counts[i] in [10^(k/2), 10^((k+1)/2)) with
/// k = first + i. Zeros, which have no logarithm, apart. What is beyond 1e-18 or 1e6 is counted in
/// the outermost half decades.
struct LogHistogram {
  std::size_t zero = 0;
  int first = 0;
  std::vector<std::size_t> counts;  ///< empty or without zeros at its ends

  bool operator==(const LogHistogram&) const = default;
};

/// Of finite values that are not negative.
LogHistogram log_histogram(const std::vector<double>& values);

}  // namespace touchstone
