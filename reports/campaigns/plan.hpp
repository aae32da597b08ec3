#pragma once

#include <boost/icl/interval_set.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "reports/sampler.hpp"

namespace touchstone {

/// How a campaign is cut into units of work, the same however it is shared out: numbers go through
/// all cells with the first configurations of each, then through all with the next ones. A piece of
/// consecutive numbers has its share of every cell, cheap and dear.
struct Cut {
  std::uint64_t cells;
  std::uint64_t count;  ///< of configurations of each cell

  std::uint64_t units() const { return cells * ((count + Unit::max_size - 1) / Unit::max_size); }
  Unit unit(std::uint64_t number) const;
};

/// Numbers of units, as ranges [first, last).
using UnitSet = boost::icl::interval_set<std::uint64_t, std::less,
                                         boost::icl::right_open_interval<std::uint64_t>>;

/// The number at a position among those of the set, in order.
std::uint64_t nth(const UnitSet& set, std::uint64_t position);
std::uint64_t configurations(const Cut& cut, const UnitSet& set);

/// One of `of` equal parts, numbered from 1.
struct Shard {
  std::uint64_t number = 1, of = 1;

  bool operator==(const Shard&) const = default;
  /// A run of consecutive units; those of all shards together are all units, each once.
  UnitSet units(const Cut& cut) const;
};
/// "3/7".
std::string to_string(const Shard& shard);
/// Throws InvalidInput (field "--shard").
Shard parse_shard(const std::string& text);

/// Everything that decides a campaign's result. Parts with the same plan belong together.
struct Plan {
  /// Configurations of each class; numbers of units and configurations of all classes do not
  /// overflow.
  static constexpr std::uint64_t max_count = Magnitudes::max_count;

  std::string version;
  std::string command;  ///< gives the same result in one process; it names every setting
  std::string program;  ///< of the command
  std::uint64_t seed = 0;
  double tolerance = 0, threshold = 0;
  std::vector<Cell> cells;
  std::vector<std::string> candidates;
  Cut cut{};
  /// All of it in JSON, as the campaign's files have it: limits, descriptions, and checksums of the
  /// plug-ins and of the first configuration of each class, which changes when a generator does.
  std::string text;
};
Plan make_plan(const Campaign& campaign, const std::string& command);

/// Throws InvalidInput on anything else than the text of a plan.
Plan plan_from_json(const nlohmann::json& json);

/// Throws InvalidInput (field `file`) naming what differs and how, unless `found` is the text of
/// the expected plan.
void require_same_plan(const Plan& expected, const nlohmann::json& found, const std::string& file);

/// CRC-32 (as in zip and PNG) as eight hexadecimal digits: finds damage, not malice.
std::string checksum(std::string_view text);

}  // namespace touchstone
