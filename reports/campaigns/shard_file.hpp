#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reports/campaigns/plan.hpp"
#include "reports/campaigns/score_tally.hpp"

namespace touchstone {

/// How far one shard has come: the tallies of the units that are done, and no others.
struct Progressed {
  Progressed(nlohmann::json plan, Shard shard);

  /// Adds the tallies of some units, in the order of `tallies`. The units must not be done yet.
  void add(const UnitSet& units, const std::vector<ScoreTally>& added);
  ScoreTally& tally(std::size_t cell, std::size_t candidate) {
    return tallies[cell * view.candidates.size() + candidate];
  }
  const ScoreTally& tally(std::size_t cell, std::size_t candidate) const {
    return tallies[cell * view.candidates.size() + candidate];
  }

  nlohmann::json plan;
  PlanView view;
  Shard shard;
  UnitSet done;
  std::vector<ScoreTally> tallies;  ///< Cell by cell, of every candidate.
};

// A shard file is JSON Lines: what it is (schema, shard, done, plan), a line for each tally, and a
// line with the checksum of all that comes before. It is at once checkpoint and result.

/// shard-3-of-7.jsonl
std::filesystem::path shard_file(const std::filesystem::path& folder, const Shard& shard);
/// Those in a folder, by name.
std::vector<std::filesystem::path> shard_files(const std::filesystem::path& folder);

std::string to_text(const Progressed& progressed);
/// `file` is what errors call it. Throws InvalidInput where the text is damaged, cut short, or of
/// something else.
Progressed progressed_from_text(const std::string& text, const std::string& file);

}  // namespace touchstone
