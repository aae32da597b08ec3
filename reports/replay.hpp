#pragma once

#include <string>
#include <vector>

#include "candidates/candidate.h"
#include "properties/identity.hpp"
#include "reports/score.hpp"

namespace touchstone {

/// Everything about one configuration as text: its class, its numbers (as a line for `solve`, and
/// in hexadecimal floats), the truth, and each candidate's answer and score. The same on every
/// call.
std::string replay_text(const Identity& identity,
                        const std::vector<const ts_candidate*>& candidates, const Bar& bar);

}  // namespace touchstone
