#include <algorithm>
#include <boost/crc.hpp>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/shard.hpp"
#include "reports/replay.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using Range = UnitSet::interval_type;

/// The unit at which part `number` of `of` begins; without overflow.
std::uint64_t start_of(const Cut& cut, std::uint64_t number, std::uint64_t of) {
  const std::uint64_t run = cut.runs() / of * number + std::min(number, cut.runs() % of);
  return std::min(cut.units(), run * cut.run_length());
}

/// Checksum of a file of any size.
std::string checksum_of_plugin(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad() || is_folder(file)) {
    throw InvalidInput("--load", '"' + file.string() + '"', "could not be read");
  }
  return checksum(text);
}

/// Calls read(element, "name[i]") for each element.
template <class Read>
void each_of(const json& plan, const char* name, Read read) {
  const json& array = member(plan, name, "campaign");
  if (!array.is_array()) throw InvalidInput(name, shown(array), "must be an array");
  for (std::size_t i = 0; i < array.size(); ++i) read(array[i], fmt::format("{}[{}]", name, i));
}

/// "candidates[1].version is 3.24, not 3.25"; lists by the first entry that differs.
std::string difference(const std::string& name, const json& expected, const json& found) {
  if (expected.is_object() && found.is_object()) {
    for (const auto& [key, value] : expected.items()) {
      const json other = found.value(key, json());
      if (other != value) return difference(name.empty() ? key : name + "." + key, value, other);
    }
  }
  if (expected.is_array() && found.is_array() && expected.size() == found.size()) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (found[i] != expected[i]) {
        return difference(fmt::format("{}[{}]", name, i), expected[i], found[i]);
      }
    }
  }
  return fmt::format("{} is {}, not {}", name, shown(found), shown(expected));
}

}  // namespace

UnitRun Cut::run(std::uint64_t first_unit) const {
  UnitRun result;
  const std::uint64_t last = std::min(units(), first_unit + run_length());
  for (std::uint64_t number = first_unit; number < last; ++number) result.push_back(unit(number));
  return result;
}

bool are_whole_runs(const Cut& cut, const UnitSet& set) {
  return std::ranges::all_of(set, [&](const Range& range) {
    const bool ends = range.upper() % cut.run_length() == 0 || range.upper() == cut.units();
    return range.lower() % cut.run_length() == 0 && ends;
  });
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
  std::uint64_t count = 0;
  const std::uint64_t smaller = cut.first_smaller();
  for (const Range& range : set) {
    count += (range.upper() - range.lower()) * cut.of_cell().size();
    count += std::min(range.upper(), smaller) - std::min(range.lower(), smaller);
  }
  return count;
}

std::vector<std::uint64_t> configurations_by_cell(const Cut& cut, const UnitSet& set) {
  // By differences between a cell and the one before: a range is so many rounds through all cells
  // and a rest, which may go on from the last cell to the first. What wraps around cancels.
  std::vector<std::uint64_t> result(cut.cells + 1);
  const auto add = [&](std::uint64_t first, std::uint64_t last, std::uint64_t size) {
    result[first] += size;
    result[last] -= size;
  };
  const auto add_units = [&](std::uint64_t begin, std::uint64_t end, std::uint64_t size) {
    const std::uint64_t length = end - begin, rest = length % cut.cells;
    const std::uint64_t first = begin % cut.cells, last = first + rest;
    add(0, cut.cells, length / cut.cells * size);
    add(first, std::min(last, cut.cells), size);
    add(0, std::max(last, cut.cells) - cut.cells, size);
  };
  const std::uint64_t smaller = cut.first_smaller();
  for (const Range& range : set) {
    add_units(range.lower(), range.upper(), cut.of_cell().size());
    add_units(std::min(range.lower(), smaller), std::min(range.upper(), smaller), 1);
  }
  result.pop_back();
  std::partial_sum(result.begin(), result.end(), result.begin());
  return result;
}

UnitSet Shard::units(const Cut& cut) const {
  UnitSet result;
  result.add(Range(start_of(cut, number - 1, of), start_of(cut, number, of)));
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

Plan make_plan(const Campaign& campaign, const std::string& command) {
  json classes = json::array(), candidates = json::array();
  std::string first_configurations;
  for (const PoseClass& cell : cells(campaign)) {
    classes.push_back({{"pair", pair_name(cell.pair)},
                       {"class", cell.name()},
                       {"description", cell.description()}});
    first_configurations += to_hex_json(make_configuration({cell, campaign.seed, 0})).dump();
  }
  for (const Candidate* c : campaign.candidates) {
    candidates.push_back(
        {{"name", c->name},
         {"family", c->family},
         {"version", c->version},
         {"settings", c->settings},
         {"models", c->models},
         {"plugin_checksum",
          c->command() ? checksum(c->command()->line) : checksum_of_plugin(c->plugin()->file)}});
    // Left out where it is usual, as in campaigns that were begun before it was known.
    if (c->runs != "native") candidates.back()["runs"] = c->runs;
  }
  return plan_from_json({{"version", TOUCHSTONE_VERSION},
                         {"command", command},
                         {"program", program_name()},
                         {"seed", campaign.seed},
                         {"count", campaign.count},
                         {"unit_size", Unit::max_size},
                         {"run_size", run_size},
                         {"tolerance", campaign.bar.tolerance},
                         {"threshold", campaign.bar.threshold},
                         {"time_limit", campaign.limits.seconds},
                         {"memory_limit", campaign.limits.mebibytes},
                         {"max_timeouts", max_timeouts},
                         {"classes", classes},
                         {"first_configurations_checksum", checksum(first_configurations)},
                         {"candidates", candidates}});
}

Plan plan_from_json(const json& j) {
  const auto text_of = [&](const char* name) { return string(member(j, name, "campaign"), name); };
  const auto number_of = [&](const char* name) {
    return number(member(j, name, "campaign"), name);
  };
  Plan plan;
  plan.cut.count = whole_number(member(j, "count", "campaign"), "campaign.count", Plan::max_count);
  for (const auto& [name, size] :
       {std::pair("unit_size", Unit::max_size), std::pair("run_size", run_size)}) {
    const json& found = member(j, name, "campaign");
    if (found == size) continue;
    throw InvalidInput(std::string("campaign.") + name, shown(found),
                       fmt::format("must be {}, as this version has it", size));
  }
  plan.seed = whole_number(member(j, "seed", "campaign"), "campaign.seed");
  plan.version = text_of("version");
  plan.command = text_of("command");
  plan.program = text_of("program");
  plan.tolerance = number_of("tolerance");
  plan.threshold = number_of("threshold");
  each_of(j, "classes", [&](const json& c, const std::string& path) {
    const auto text = [&](const char* name) {
      return string(member(c, name, path), path + '.' + name);
    };
    const PoseClass cell(parse_pair(text("pair")), text("class"));
    for (const PoseClass& other : plan.cells) {
      if (other == cell) {
        throw InvalidInput(path, shown(c), "must be another class: it is given twice");
      }
    }
    plan.cells.push_back(cell);
  });
  each_of(j, "candidates", [&](const json& c, const std::string& path) {
    plan.candidates.push_back(readable(string(member(c, "name", path), path + ".name")));
    plan.runs.push_back(c.contains("runs") ? string(c["runs"], path + ".runs") : "native");
  });
  plan.cut.cells = plan.cells.size();
  if (plan.cells.empty() || plan.cut.count == 0) {
    throw InvalidInput("campaign", "empty", "must have classes and a count");
  }
  plan.text = j.dump();
  return plan;
}

void require_same_plan(const Plan& plan, const json& found, const std::string& file) {
  const json expected = json::parse(plan.text);
  if (expected == found) return;
  // Members that follow from others tell less than those.
  json settings = expected, other_settings = found.is_object() ? found : json::object();
  for (const char* derived : {"command", "first_configurations_checksum"}) {
    settings.erase(derived);
    other_settings.erase(derived);
  }
  const std::string what = settings == other_settings ? difference("", expected, found)
                                                      : difference("", settings, other_settings);
  throw InvalidInput('"' + file + '"', "of another campaign",
                     what + "; parts of different campaigns are never put together");
}

std::string checksum(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}", crc.checksum());
}

std::string checksum(std::span<const std::string> texts) {
  boost::crc_32_type crc;
  for (const std::string& text : texts) crc.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}", crc.checksum());
}

}  // namespace touchstone
