#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "candidates/host/ask_cast.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

/// Measure of a configuration's numbers: their significant bits and exponents. Zeros cost nothing,
/// ones little, the identity orientation less than others.
int complexity(const Configuration& configuration);
int complexity(const CastQuestion& cast);

/// Configurations of the same pair and lower complexity, large steps first: bodies moved to the
/// origin, no rotation, sizes of one, numbers of fewer digits. They need not have the same signed
/// distance. Since every step lowers the complexity, repetition terminates.
std::vector<Configuration> simpler(const Configuration& configuration);
/// Likewise casts, whose sweeps become simpler, too.
std::vector<CastQuestion> simpler(const CastQuestion& cast);

/// Follows `simpler` with at most `max_trials` steps tried. `first_failing` is given the next ones
/// together, and returns the place of the first that fails, or their number.
template <class Case, class FirstFailing>
Case simplified_in_batches(Case best, FirstFailing first_failing, std::size_t max_trials) {
  for (std::size_t trials = 0; trials < max_trials;) {
    std::vector<Case> next = simpler(best);
    const std::size_t count = std::min(next.size(), max_trials - trials);
    next.erase(next.begin() + static_cast<std::ptrdiff_t>(count), next.end());
    const std::size_t at = first_failing(next);
    if (at == count) break;
    trials += at + 1;
    best = std::move(next[at]);
  }
  return best;
}

/// Follows `simpler` while `still_fails`, with at most `max_trials` calls of it. The result fails
/// if the configuration does.
Configuration simplified(const Configuration& configuration,
                         const std::function<bool(const Configuration&)>& still_fails,
                         int max_trials = 2000);

}  // namespace touchstone
