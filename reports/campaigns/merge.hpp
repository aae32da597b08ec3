#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/campaigns/shard.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// Puts parts of one campaign together, one after the other. The sum does not depend on how the
/// campaign was cut nor on the order of the parts.
class Merge {
 public:
  /// `file` is what errors call the part. Throws InvalidInput where it belongs to another campaign
  /// or holds a unit that an earlier part holds.
  void add(const ShardState& part, const std::string& file);

  /// The sum as the only shard of all. Throws InvalidInput where units are missing, unless they
  /// may, or without any part.
  ShardState whole(bool may_be_partial) const;

 private:
  struct Part {
    std::string file;
    UnitSet units;
  };
  std::vector<ShardState> sum_;  ///< one, once there is a part
  std::vector<Part> parts_;
};

/// Merges shard files, and folders that hold some. Throws InvalidInput as Merge and shard_from_text
/// do.
ShardState merge(const std::vector<std::filesystem::path>& inputs, bool may_be_partial);

// MPI (Open MPI). Ranks are processes that mpirun has started; each runs its own shard, without a
// word to the others, in worker processes of its own. Those must not be forked once MPI runs, so
// MPI is initialised only when all is done, for the one message that each rank has: its tallies.

/// This process's rank as a shard, from the environment that mpirun gives; 1/1 outside of it.
Shard shard_of_rank();
/// Has mpirun started this process, alone or with others?
bool under_mpirun();

/// Merges the parts of all ranks of mpirun, each of which calls it once: the first rank merges them
/// into `merge`, the others send theirs. Returns whether this is the first rank.
bool gather(const ShardState& part, Merge& merge);

/// Result of a campaign: of a report, what does not depend on how, where and how fast it ran.
Report campaign_result(const ShardState& whole);

/// campaign.json (docs/campaign.md): the members of report.json that a campaign has.
std::string campaign_json(const ShardState& whole);

/// Writes campaign.json as a whole or not at all; returns its name. Throws InvalidInput (field
/// "--out") where that cannot be done.
std::filesystem::path write_result(const ShardState& whole, const std::filesystem::path& folder);

}  // namespace touchstone
