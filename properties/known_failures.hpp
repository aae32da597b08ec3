#pragma once

#include <vector>

#include "properties/numbers.hpp"

namespace touchstone {

/// Configurations that some contact routine once answered wrongly, ours or an engine's (those of
/// known_failures.jsonl). None for a plane.
const std::vector<Numbers>& known_failures(Pair pair);

}  // namespace touchstone
