#pragma once

#include <functional>
#include <vector>

#include "reference/configuration.hpp"

namespace touchstone {

/// How much there is to read in a configuration: significant bits and exponents of all its numbers,
/// where zeros cost nothing and ones little, and an orientation less when it is none.
int complexity(const Configuration& configuration);

/// Configurations of the same pair and less complexity, the boldest steps first: bodies moved to
/// the origin, no rotation, sizes of one, numbers of fewer digits. None is meant to have the same
/// signed distance. Since complexity falls with every step, taking them again and again ends.
std::vector<Configuration> simpler(const Configuration& configuration);

/// Follows `simpler` as long as `still_fails`, and at most for `most_trials` calls of it. The
/// result fails, if the configuration does.
Configuration simplified(const Configuration& configuration,
                         const std::function<bool(const Configuration&)>& still_fails,
                         int most_trials = 2000);

}  // namespace touchstone
