#include "campaigns/shard_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "campaigns/durable_file.hpp"
#include "reference/invalid_input.hpp"

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

Progressed parsed(const std::string& text, const std::string& file) {
  std::istringstream lines{text};
  std::string line;
  std::getline(lines, line);
  const json head = json::parse(line);
  if (head.at("schema") != schema) refuse(file, "of schema " + head.at("schema").dump());
  Progressed result(head.at("campaign"), {head.at("shard").at(0), head.at("shard").at(1)});
  result.done = unit_set_from_json(head.at("done"));
  for (ScoreTally& tally : result.tallies) {
    if (!std::getline(lines, line)) refuse(file, "without some of its tallies");
    const auto number = static_cast<std::size_t>(&tally - result.tallies.data());
    tally = ScoreTally::from_json(json::parse(line).at("tally"),
                                  number / result.view.candidates.size());
  }
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
  } catch (const json::exception& e) {
    refuse(file, fmt::format("not understood ({})", e.what()));
  }
}

}  // namespace touchstone
