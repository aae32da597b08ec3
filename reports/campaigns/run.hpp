#pragma once

#include <filesystem>
#include <functional>

#include "reports/campaigns/shard_file.hpp"

namespace touchstone {

/// How a shard is run; none of it changes the result.
struct Running {
  double interval = 30;  ///< Seconds between checkpoints, by a clock that never jumps.
  bool progress = true;  ///< Show it on standard error.
};

/// Scores the units of the shard that are not done yet, spread over worker processes, and writes
/// `file` at every interval, at the end, and before an error goes on. Ends early, with the file
/// written, once `go_on` says no; units in hand are lost. The result does not depend on workers or
/// interruptions. Returns whether all is done.
bool run_shard(const Campaign& campaign, Progressed& progressed, const std::filesystem::path& file,
               const Running& running, const std::function<bool()>& go_on);

/// Tallies of one unit, for every candidate, each in a new session.
std::vector<ScoreTally> tally_unit(const Campaign& campaign,
                                   std::vector<CandidateProcess>& candidates, const Cell& cell,
                                   const Unit& unit);

}  // namespace touchstone
