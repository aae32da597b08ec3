#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "candidates/host/candidate_process.hpp"
#include "properties/identity.hpp"

namespace touchstone {

/// Everything about one configuration as text: its class, its numbers (as a line for `solve`, and
/// in hexadecimal floats), the truth, and each candidate's answer and score in the order of
/// `candidates`. `examined` is what examine() gives of the subject and these candidates, as JSON.
std::string replay_text(const Subject& subject, const nlohmann::json& examined,
                        const std::vector<CandidateProcess>& candidates);

}  // namespace touchstone
