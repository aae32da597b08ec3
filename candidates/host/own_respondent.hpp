#pragma once

#include <memory>

#include "candidates/host/respondent.hpp"

namespace touchstone {

/// Does the candidate come with Touchstone, without an engine: our routines and simplified models?
bool is_own(const Candidate& candidate);

/// Asks such a candidate in this process. Its code is trusted as far as this program's, so that it
/// needs no process of its own, and an exchange of messages takes a hundred times as long as an
/// answer. Nothing is timed, and no limits hold.
std::unique_ptr<Respondent> own_respondent(const Candidate& candidate, double threshold);

}  // namespace touchstone
