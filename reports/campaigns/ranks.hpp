#pragma once

#include <string>

#include "reports/campaigns/merge.hpp"

namespace touchstone {

// MPI (Open MPI). Ranks are processes that mpirun has started; each runs its own shard, without a
// word to the others, in worker processes of its own. Those must not be forked once MPI runs, so
// MPI is initialised only when all is done, for the one message that each rank has: its tallies.

/// This process's rank as a shard, from the environment that mpirun gives; 1/1 outside of it.
Shard shard_of_rank();
/// Has mpirun started this process, alone or with others?
bool under_mpirun();

/// Called by every rank of mpirun, once: the first rank merges all parts into `merge`, the others
/// send theirs. Returns whether this is the first rank.
bool gather(const Progressed& part, Merge& merge);

}  // namespace touchstone
