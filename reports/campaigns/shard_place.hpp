#pragma once

#include <filesystem>

#include "reports/campaigns/durable_file.hpp"
#include "reports/campaigns/shard_file.hpp"

namespace touchstone {

/// Where one shard is kept: its file in a campaign's folder, locked as long as this lives.
class ShardPlace {
 public:
  /// Makes the folder. Throws InvalidInput (field "--out") where nothing can be written or another
  /// process is at work on the same shard.
  ShardPlace(std::filesystem::path folder, const Shard& shard);

  const std::filesystem::path& file() const { return file_; }

  /// The shard as its file has it, or at its beginning where there is none. Throws InvalidInput
  /// where there is one and `resume` is false, where it is damaged or of another campaign, and
  /// where the folder holds shards of another campaign or of another cut.
  Progressed begin(const nlohmann::json& plan, bool resume) const;

 private:
  std::filesystem::path folder_;
  Shard shard_;
  std::filesystem::path file_;
  FileLock lock_;
};

}  // namespace touchstone
