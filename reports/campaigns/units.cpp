#include "reports/campaigns/units.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <stdexcept>

#include "properties/files/json_fields.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using Range = UnitSet::interval_type;

/// Where part `number` of `of` begins; without overflow.
std::uint64_t start_of(std::uint64_t units, std::uint64_t number, std::uint64_t of) {
  return units / of * number + std::min(number, units % of);
}

}  // namespace

Unit Cut::unit(std::uint64_t number) const {
  const std::uint64_t first = number / cells * unit_size;
  return {number % cells, first, std::min(count, first + unit_size)};
}

std::uint64_t nth(const UnitSet& set, std::uint64_t position) {
  for (const Range& range : set) {
    const std::uint64_t length = range.upper() - range.lower();
    if (position < length) return range.lower() + position;
    position -= length;
  }
  throw std::logic_error("no such position in the set of units");
}

std::uint64_t configurations(const Cut& cut, const UnitSet& set) {
  // All units have the same size but the last of each cell.
  std::uint64_t count = 0;
  const std::uint64_t last_row = cut.units() - cut.cells;
  const std::uint64_t last_size = cut.count - last_row / cut.cells * Cut::unit_size;
  for (const Range& range : set) {
    const std::uint64_t full =
        std::min(range.upper(), last_row) - std::min(range.lower(), last_row);
    count += full * Cut::unit_size + (range.upper() - range.lower() - full) * last_size;
  }
  return count;
}

nlohmann::json to_json(const UnitSet& set) {
  nlohmann::json result = nlohmann::json::array();
  for (const Range& range : set) result.push_back({range.lower(), range.upper()});
  return result;
}

UnitSet unit_set_from_json(const nlohmann::json& json) {
  UnitSet result;
  if (!json.is_array()) throw InvalidInput("done", shown(json), "must be an array of ranges");
  for (const nlohmann::json& range : json) {
    const bool is_pair = range.is_array() && range.size() == 2;
    if (!is_pair) throw InvalidInput("done", shown(range), "must be a range, as in [0, 12]");
    const auto last = whole_number(range[1], "done");
    result.add(Range(whole_number(range[0], "done", last), last));
  }
  return result;
}

UnitSet Shard::units(const Cut& cut) const {
  UnitSet result;
  result.add(Range(start_of(cut.units(), number - 1, of), start_of(cut.units(), number, of)));
  return result;
}

std::string to_string(const Shard& shard) { return fmt::format("{}/{}", shard.number, shard.of); }

Shard parse_shard(const std::string& text) {
  Shard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto [slash, bad_number] = std::from_chars(text.data(), end, shard.number);
  const bool has_slash = bad_number == std::errc() && slash != end && *slash == '/';
  const auto [rest, bad_of] =
      has_slash ? std::from_chars(slash + 1, end, shard.of) : std::from_chars_result{slash, {}};
  if (!has_slash || bad_of != std::errc() || rest != end || shard.number < 1 ||
      shard.number > shard.of) {
    throw InvalidInput("--shard", '"' + text + '"', "must read 3/7 for the third of seven parts");
  }
  return shard;
}

}  // namespace touchstone
