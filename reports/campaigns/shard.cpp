#include "reports/campaigns/shard.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/bytes.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using Range = UnitSet::interval_type;

}  // namespace

json to_json(const UnitSet& set) {
  json result = json::array();
  for (const Range& range : set) result.push_back({range.lower(), range.upper()});
  return result;
}

UnitSet unit_set_from_json(const json& value) {
  UnitSet result;
  if (!value.is_array()) throw InvalidInput("done", shown(value), "must be an array of ranges");
  for (const json& range : value) {
    const bool is_pair = range.is_array() && range.size() == 2;
    if (!is_pair) throw InvalidInput("done", shown(range), "must be a range, as in [0, 12]");
    const auto last = whole_number(range[1], "done");
    result.add(Range(whole_number(range[0], "done", last), last));
  }
  return result;
}

namespace {

constexpr const char* schema = "touchstone-shard-4";

/// The parts of a shard file: its first line, the samples, and the last line.
std::array<std::string, 3> parts_of(const ShardState& state) {
  std::array<std::string, 3> parts;
  parts[0] = json{{"schema", schema},
                  {"shard", {state.shard.number, state.shard.of}},
                  {"done", to_json(state.done)},
                  {"campaign", json::parse(state.plan.text)}}
                 .dump() +
             '\n';
  BytesOut bytes;
  for (const Sample& sample : state.samples) bytes(sample);
  parts[1] = bytes.take();
  parts[2] = checksum(std::span(parts).first(2)) + '\n';
  return parts;
}

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw InvalidInput(
      '"' + file + '"', why,
      "must be a shard file as touchstone campaign has written it; delete it and run "
      "that part again");
}

/// Refuses what merge or campaign wrote beside the shard files, which is good but none of them.
void refuse_result(std::string_view text, const std::string& file) {
  if (text.find("\"touchstone-campaign-") == text.npos) return;
  throw InvalidInput('"' + file + '"', "the result of a campaign",
                     "must be a shard file, shard-….bin, as there is one beside it");
}

/// What comes before the last line, which must be its checksum.
std::string_view intact(std::string_view text, const std::string& file) {
  constexpr std::size_t last_line = 9;  // eight digits and its end
  const std::string_view body = text.substr(0, text.size() - std::min(text.size(), last_line));
  if (text.substr(body.size()) != checksum(body) + '\n') {
    refuse_result(text, file);
    refuse(file, "damaged, cut short, or something else");
  }
  return body;
}

/// [3, 7].
Shard shard_from_json(const json& value) {
  if (!value.is_array() || value.size() != 2) {
    throw InvalidInput("shard", shown(value), "must be two numbers, as in [3, 7]");
  }
  const Shard shard{whole_number(value[0], "shard[0]"), whole_number(value[1], "shard[1]")};
  if (shard.number < 1 || shard.number > shard.of) {
    throw InvalidInput("shard", shown(value), "must be a part and how many there are");
  }
  return shard;
}

/// Each candidate has answered what is done of each class, and nothing else.
void check_counts(const ShardState& state, const std::string& file) {
  const std::vector<std::uint64_t> expected = configurations_by_cell(state.plan.cut, state.done);
  for (std::size_t cell = 0; cell < state.samples.size(); ++cell) {
    const std::vector<ScoreTally>& tallies = state.samples[cell].tallies;
    const auto is_of_cell = [&](const ScoreTally& tally) {
      return tally.count == expected[cell] && std::ranges::all_of(tally.worst, [&](const Case& c) {
               return c.cell == cell && c.index < state.plan.cut.count;
             });
    };
    if (tallies.size() != state.plan.candidates.size() ||
        !std::ranges::all_of(tallies, is_of_cell)) {
      refuse(file, "with counts of something else than what is done");
    }
  }
}

ShardState parsed(std::string_view text, const std::string& file) {
  const std::string_view first_line = text.substr(0, text.find('\n'));
  const json head = parse_json(first_line, "line 1");
  if (member(head, "schema", "") != schema) {
    refuse(file, fmt::format("of schema {} and not \"{}\"", shown(head["schema"]), schema));
  }
  ShardState result(plan_from_json(member(head, "campaign", "")),
                    shard_from_json(member(head, "shard", "")));
  result.done = unit_set_from_json(member(head, "done", ""));
  if (!boost::icl::within(result.done, result.shard.units(result.plan.cut))) {
    refuse(file, "with work done that is not its own");
  }
  if (!are_whole_runs(result.plan.cut, result.done)) refuse(file, "with a run done in part");
  BytesIn bytes(text.substr(std::min(text.size(), first_line.size() + 1)));
  for (Sample& sample : result.samples) bytes(sample);
  if (!bytes.is_at_end()) refuse(file, "with more than its classes and candidates");
  check_counts(result, file);
  return result;
}

}  // namespace

ShardState::ShardState(Plan of, Shard which)
    : plan(std::move(of)),
      shard(which),
      samples(plan.cells.size(), Sample(plan.candidates.size(), Resolution::eighths)) {}

void ShardState::add(const UnitSet& units, const std::vector<Sample>& added) {
  if (boost::icl::intersects(done, units)) throw std::logic_error("a unit was counted twice");
  for (std::size_t cell = 0; cell < samples.size(); ++cell) samples[cell].add(added[cell]);
  done += units;
}

std::filesystem::path shard_file(const std::filesystem::path& folder, const Shard& shard) {
  return folder / fmt::format("shard-{}-of-{}.bin", shard.number, shard.of);
}

std::vector<std::filesystem::path> shard_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("shard-") && name.ends_with(".bin")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string to_text(const ShardState& state) {
  return fmt::format("{}", fmt::join(parts_of(state), ""));
}

void write_shard(const ShardState& state, const std::filesystem::path& file) {
  const auto parts = parts_of(state);
  write_file(file, {parts.begin(), parts.end()}, "--out", "make room, then go on with --resume");
}

ShardState read_shard(const std::filesystem::path& file, const char* field) {
  // Of all candidates and classes, 7 KB for each of 105,000 tallies once the histograms fill up.
  constexpr std::size_t max_shard_size = std::size_t{1} << 32;
  std::error_code error;
  const bool ordinary = std::filesystem::is_regular_file(file, error);
  return shard_from_text(read_file(file, field, ordinary ? max_shard_size : max_file_size),
                         file.string());
}

ShardState shard_from_text(std::string_view text, const std::string& file) {
  try {
    return parsed(intact(text, file), file);
  } catch (const InvalidInput& e) {
    if (e.field() == '"' + file + '"') throw;
    refuse(file, fmt::format("not understood ({})", error_text(e)));
  } catch (const std::logic_error& e) {
    refuse(file, fmt::format("not understood ({})", e.what()));
  }
}

}  // namespace touchstone
