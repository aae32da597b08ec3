#pragma once

#include <string>
#include <vector>

#include "candidates/candidate_process.hpp"
#include "reports/worst.hpp"

namespace touchstone {

/// Everything about one configuration as text: its class, its numbers (as a line for `solve`, and
/// in hexadecimal floats), the truth, and each candidate's answer and score. The same on every
/// call.
std::string replay_text(const Subject& subject, std::vector<CandidateProcess>& candidates,
                        const Bar& bar);

}  // namespace touchstone
