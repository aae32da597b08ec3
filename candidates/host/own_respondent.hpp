#pragma once

#include "candidates/candidates.hpp"

namespace touchstone {

/// Does the candidate come with Touchstone, without an engine: our routines and simplified models?
bool is_own(const Candidate& candidate);

/// Such a candidate, asked in the process that it is used in. Its code is trusted as far as this
/// program's, so that it needs no process of its own, and an exchange of messages takes a hundred
/// times as long as an answer. It is not timed, and no limits hold.
Candidate asked_here(const Candidate& candidate);

}  // namespace touchstone
