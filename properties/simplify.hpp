#pragma once

#include <functional>
#include <vector>

#include "reference/configuration.hpp"

namespace touchstone {

/// Measure of a configuration's numbers: their significant bits and exponents. Zeros cost nothing,
/// ones little, the identity orientation less than others.
int complexity(const Configuration& configuration);

/// Configurations of the same pair and lower complexity, large steps first: bodies moved to the
/// origin, no rotation, sizes of one, numbers of fewer digits. They need not have the same signed
/// distance. Since every step lowers the complexity, repetition terminates.
std::vector<Configuration> simpler(const Configuration& configuration);

/// Follows `simpler` while `still_fails`, with at most `max_trials` calls of it. The result fails
/// if the configuration does.
Configuration simplified(const Configuration& configuration,
                         const std::function<bool(const Configuration&)>& still_fails,
                         int max_trials = 2000);

}  // namespace touchstone
