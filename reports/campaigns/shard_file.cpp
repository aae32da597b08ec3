#include "reports/campaigns/shard_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "properties/files/error_text.hpp"
#include "properties/files/json_fields.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/durable_file.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr const char* schema = "touchstone-shard-1";

std::string checksum_line(std::string_view text) {
  return json{{"crc32", checksum(text)}}.dump() + '\n';
}

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw InvalidInput(
      '"' + file + '"', why,
      "must be a shard file as touchstone campaign has written it; delete it and run "
      "that part again");
}

/// What comes before the last line, which must be its checksum.
std::string_view intact(std::string_view text, const std::string& file) {
  const std::size_t last_line =
      text.size() < 2 ? std::string_view::npos : text.rfind('\n', text.size() - 2);
  if (last_line == std::string_view::npos ||
      text.substr(last_line + 1) != checksum_line(text.substr(0, last_line + 1))) {
    refuse(file, "damaged, cut short, or something else");
  }
  return text.substr(0, last_line + 1);
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

/// Each candidate has answered what is done, and nothing else.
void check_counts(const Progressed& p, const std::string& file) {
  const std::uint64_t expected = configurations(p.view.cut, p.done);
  for (std::size_t k = 0; k < p.view.candidates.size(); ++k) {
    std::uint64_t left = expected;
    for (std::size_t cell = 0; cell < p.view.cells.size(); ++cell) {
      const ScoreTally& tally = p.tally(cell, k);
      if (tally.count() > left) refuse(file, "with counts of more than what is done");
      left -= tally.count();
      for (const Case& c : tally.worst()) {
        if (c.index >= p.view.cut.count) refuse(file, "with cases that the campaign has not");
      }
    }
    if (left != 0) refuse(file, "with counts of less than what is done");
  }
}

Progressed parsed(const std::string& text, const std::string& file) {
  std::istringstream lines{text};
  std::string line;
  std::getline(lines, line);
  const json head = parse_json(line, "line 1");
  if (member(head, "schema", "") != schema) refuse(file, "of schema " + shown(head["schema"]));
  const json& plan = member(head, "campaign", "");
  const PlanView view(plan);
  const auto tally_lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 1;
  if (view.candidates.empty() || tally_lines % view.candidates.size() != 0 ||
      tally_lines / view.candidates.size() != view.cells.size()) {
    refuse(file, "without a line for each class and candidate");
  }
  Progressed result(plan, shard_from_json(member(head, "shard", "")));
  result.done = unit_set_from_json(member(head, "done", ""));
  if (!boost::icl::within(result.done, result.shard.units(result.view.cut))) {
    refuse(file, "with work done that is not its own");
  }
  for (std::size_t i = 0; i < result.tallies.size(); ++i) {
    std::getline(lines, line);
    const std::string name = fmt::format("line {}", i + 2);
    result.tallies[i] = at_path(name, [&] {
      const json object = parse_json(line, "it");
      return ScoreTally::from_json(member(object, "tally", ""), i / result.view.candidates.size());
    });
  }
  check_counts(result, file);
  return result;
}

}  // namespace

Progressed::Progressed(json made, Shard of)
    : plan(std::move(made)),
      view(plan),
      shard(of),
      tallies(view.cells.size() * view.candidates.size()) {}

void Progressed::add(const UnitSet& units, const std::vector<ScoreTally>& added) {
  if (boost::icl::intersects(done, units)) throw std::logic_error("a unit was counted twice");
  for (std::size_t i = 0; i < tallies.size(); ++i) tallies[i].add(added[i]);
  done += units;
}

std::filesystem::path shard_file(const std::filesystem::path& folder, const Shard& shard) {
  return folder / fmt::format("shard-{}-of-{}.jsonl", shard.number, shard.of);
}

std::vector<std::filesystem::path> shard_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("shard-") && name.ends_with(".jsonl")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string to_text(const Progressed& p) {
  std::string text = json{{"schema", schema},
                          {"shard", {p.shard.number, p.shard.of}},
                          {"done", to_json(p.done)},
                          {"campaign", p.plan}}
                         .dump() +
                     '\n';
  for (std::size_t cell = 0; cell < p.view.cells.size(); ++cell) {
    for (std::size_t k = 0; k < p.view.candidates.size(); ++k) {
      text += json{{"pair", pair_name(p.view.cells[cell].pair)},
                   {"class", p.view.cells[cell].pose_class},
                   {"candidate", p.view.candidates[k]},
                   {"tally", p.tally(cell, k).to_json()}}
                  .dump() +
              '\n';
    }
  }
  return text + checksum_line(text);
}

Progressed progressed_from_text(const std::string& text, const std::string& file) {
  const std::string body(intact(text, file));
  try {
    return parsed(body, file);
  } catch (const InvalidInput& e) {
    if (e.field() == '"' + file + '"') throw;
    refuse(file, fmt::format("not understood ({})", error_text(e)));
  }
}

}  // namespace touchstone
