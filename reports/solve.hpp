#pragma once

#include <iosfwd>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"

namespace touchstone {

struct SolveOptions {
  std::vector<const Candidate*> candidates;
  double width = 1e-30;  ///< of the truth, relative to the larger size
  Bar bar;
  bool audit = false;  ///< let the second oracle check every truth
  Limits limits = {};  ///< of each candidate on one configuration
};

/// One JSON object a line in, one a line out (docs/solve.md). A bad line is answered with an error
/// object and the rest go on; returns false if there was any. Throws Contradiction if the two
/// oracles disagree.
bool solve(std::istream& in, std::ostream& out, const SolveOptions& options);

}  // namespace touchstone
