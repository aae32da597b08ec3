#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "reports/campaigns/plan.hpp"
#include "reports/score_tally.hpp"

namespace touchstone {

/// How far one shard has come: the tallies of the units that are done, and no others.
struct ShardState {
  ShardState(Plan plan, Shard shard);

  /// Adds the tallies of some units, in the order of `tallies`. The units must not be done yet.
  void add(const UnitSet& units, const std::vector<ScoreTally>& added);
  ScoreTally& tally(std::size_t cell, std::size_t candidate) {
    return tallies[cell * plan.candidates.size() + candidate];
  }
  const ScoreTally& tally(std::size_t cell, std::size_t candidate) const {
    return tallies[cell * plan.candidates.size() + candidate];
  }

  Plan plan;
  Shard shard;
  UnitSet done;
  std::vector<ScoreTally> tallies;  ///< binned; cell by cell, of every candidate
};

// A shard file is JSON Lines: what it is (schema, shard, done, plan), a line for each tally, and a
// line with the checksum of all that comes before. It is at once checkpoint and result.

/// shard-3-of-7.jsonl
std::filesystem::path shard_file(const std::filesystem::path& folder, const Shard& shard);
/// Those in a folder, by name.
std::vector<std::filesystem::path> shard_files(const std::filesystem::path& folder);

/// Writes a shard file as a whole or not at all. Throws InvalidInput (field "--out") where that
/// cannot be done.
void write_shard(const ShardState& state, const std::filesystem::path& file);

std::string to_text(const ShardState& state);
/// `file` is what errors call it. Throws InvalidInput where the text is damaged, cut short, or of
/// something else.
ShardState shard_from_text(const std::string& text, const std::string& file);

/// [[first, last], …], and back; throws InvalidInput on anything else.
nlohmann::json to_json(const UnitSet& set);
UnitSet unit_set_from_json(const nlohmann::json& json);

/// A binned tally as it stands in a shard file.
nlohmann::json to_json(const ScoreTally& tally);
/// Reads a tally whose cases are all of this cell. Throws InvalidInput on anything else than
/// to_json gives.
ScoreTally tally_from_json(const nlohmann::json& json, std::size_t cell);

}  // namespace touchstone
