#pragma once

#include <filesystem>
#include <functional>

#include <nlohmann/json_fwd.hpp>

#include "reports/campaigns/shard.hpp"

namespace touchstone {

/// Held by one process at a time, and let go when it ends, however it does: a record lock, which
/// its children do not hold.
class FileLock {
 public:
  /// Makes the file. Throws InvalidInput (field "--out") if another process holds it.
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int fd_;
};

/// Place of one shard: its file in a campaign's folder, locked as long as this lives.
class ShardPlace {
 public:
  /// Makes the folder. Throws InvalidInput (field "--out") where nothing can be written or another
  /// process is at work on the same shard.
  ShardPlace(std::filesystem::path folder, const Shard& shard);

  const std::filesystem::path& file() const { return file_; }

  /// The shard as its file has it, or at its beginning where there is none. Throws InvalidInput
  /// where there is one and `resume` is false, where it is damaged, of another campaign or another
  /// shard, and where the folder holds shards of another campaign or of another cut.
  ShardState begin(const Plan& plan, bool resume) const;

 private:
  std::filesystem::path folder_;
  Shard shard_;
  std::filesystem::path file_;
  FileLock lock_;
};

/// How a shard is run; none of it changes the result.
struct RunOptions {
  double interval = 30;  ///< seconds between checkpoints, by a clock that never jumps
  bool progress = true;  ///< shown on standard error
};

/// Scores the units of the shard that are not done yet, spread over worker processes, and writes
/// `file` at every interval, at the end, and before an error goes on. Ends early, with the file
/// written, once `go_on` says no; units in hand are lost. The result does not depend on workers or
/// interruptions. Returns whether all is done.
bool run_shard(const Campaign& campaign, ShardState& state, const std::filesystem::path& file,
               const RunOptions& options, const std::function<bool()>& go_on);

}  // namespace touchstone
