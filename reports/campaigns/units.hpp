#pragma once

#include <boost/icl/interval_set.hpp>
#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {

/// A run of configurations of one cell (pair × class): indices first … last − 1.
struct Unit {
  std::size_t cell;
  std::uint64_t first, last;
};

/// How a campaign is cut into units of work, the same however it is shared out: numbers go through
/// all cells with the first configurations of each, then through all with the next ones. A piece of
/// consecutive numbers has its share of every cell, cheap and dear.
struct Cut {
  std::uint64_t cells;
  std::uint64_t count;  ///< Of configurations of each cell.

  /// Few enough that a checkpoint loses little, enough that new sessions cost little.
  static constexpr std::uint64_t unit_size = 512;

  std::uint64_t units() const { return cells * ((count + unit_size - 1) / unit_size); }
  Unit unit(std::uint64_t number) const;
};

/// Numbers of units, as ranges [first, last).
using UnitSet = boost::icl::interval_set<std::uint64_t, std::less,
                                         boost::icl::right_open_interval<std::uint64_t>>;

/// The number at a position among those of the set, in order.
std::uint64_t nth(const UnitSet& set, std::uint64_t position);
std::uint64_t configurations(const Cut& cut, const UnitSet& set);

/// [[first, last], …], and back; throws InvalidInput on anything else.
nlohmann::json to_json(const UnitSet& set);
UnitSet unit_set_from_json(const nlohmann::json& json);

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

}  // namespace touchstone
