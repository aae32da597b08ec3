#include "reports/campaigns/shard.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/answer_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using Range = UnitSet::interval_type;

json to_json(const Case& c) {
  return {{"index", c.index},
          {"outcome", outcome_name(c.score.outcome)},
          {"depth_error", or_null(c.score.depth_error)},
          {"normal_regret", or_null(c.score.normal_regret)},
          {"severity", c.score.severity}};
}

Case case_from_json(const json& j, std::size_t cell) {
  Score score;
  score.outcome = outcome_from_json(member(j, "outcome", ""), "outcome");
  score.depth_error = number_or_null(member(j, "depth_error", ""), "depth_error");
  score.normal_regret = number_or_null(member(j, "normal_regret", ""), "normal_regret");
  score.severity = number(member(j, "severity", ""), "severity");
  return {cell, whole_number(member(j, "index", ""), "index"), score};
}

/// {"max", "bins": [number, count, number, count, …]}.
json to_json(const Magnitudes& magnitudes) {
  json bins = json::array();
  for (const auto& [bin, count] : magnitudes.bins()) {
    bins.push_back(bin);
    bins.push_back(count);
  }
  return {{"max", magnitudes.max()}, {"bins", bins}};
}

/// Numbers by outcome that add up to `sum`.
OutcomeCounts outcome_counts(const json& j, const std::string& name, std::uint64_t sum) {
  OutcomeCounts result{};
  require_object(j, name);
  for (const auto& [outcome, count] : j.items()) {
    auto& number = result[static_cast<std::size_t>(outcome_from_json(outcome, "outcome"))];
    number = whole_number(count, fmt::format("{}.{}", name, outcome), sum);
    sum -= number;
  }
  if (sum != 0) throw InvalidInput(name, shown(j), "must add up to the count");
  return result;
}

/// `max_count`: of values.
Magnitudes magnitudes_from_json(const json& j, std::uint64_t max_count) {
  const double max = number(member(j, "max", ""), "max");
  if (!(std::isfinite(max) && max >= 0)) {
    throw InvalidInput("max", shown(j["max"]), "must be finite and not negative");
  }
  const json& list = member(j, "bins", "");
  if (!list.is_array() || list.size() % 2 != 0) {
    throw InvalidInput("bins", shown(list), "must be an array of pairs");
  }
  Magnitudes::Bins bins;
  std::uint64_t left = Magnitudes::max_count;
  for (std::size_t i = 0; i < list.size(); i += 2) {
    const auto bin = whole_number(list[i], fmt::format("bins[{}]", i), Magnitudes::bin_of(max));
    const auto count = whole_number(list[i + 1], fmt::format("bins[{}]", i + 1), left);
    bins[static_cast<std::uint16_t>(bin)] += count;
    left -= count;
  }
  Magnitudes result(std::move(bins), max);
  if (result.count() > max_count) {
    throw InvalidInput("bins", fmt::format("{} values", result.count()),
                       "must hold no more than the count");
  }
  return result;
}

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

json to_json(const ScoreTally& tally) {
  json outcomes = json::object();
  json points = json::array(), worst = json::array();
  for (const Outcome outcome : all_outcomes) {
    outcomes[outcome_name(outcome)] = tally.outcomes[static_cast<std::size_t>(outcome)];
  }
  for (const auto& [number, count] : tally.points) points.push_back({number, count});
  for (const Case& c : tally.worst) worst.push_back(to_json(c));
  json result = {{"count", tally.count},
                 {"outcomes", outcomes},
                 {"points", points},
                 {"too_deep", to_json(tally.bias.negative)},
                 {"too_shallow", to_json(tally.bias.positive)},
                 {"severity", to_json(tally.severity)},
                 {"uncovered", to_json(tally.coverage.uncovered)},
                 {"covered_sum", tally.coverage.sum},
                 {"worst", worst}};
  for (std::size_t i = 0; i < tally.errors.size(); ++i) {
    result[ScoreTally::quantities[i].name] = to_json(tally.errors[i]);
  }
  return result;
}

ScoreTally tally_from_json(const json& j, std::size_t cell) {
  ScoreTally t(Precision::binned);
  t.count = whole_number(member(j, "count", ""), "count", Magnitudes::max_count);
  t.outcomes = outcome_counts(member(j, "outcomes", ""), "outcomes", t.count);
  for (const json& entry : array(member(j, "points", ""), "points")) {
    if (!entry.is_array() || entry.size() != 2) {
      throw InvalidInput("points", shown(entry), "must be an array of pairs");
    }
    const auto points = whole_number(entry[0], "points", TOUCHSTONE_MAX_POINTS);
    t.points[static_cast<int>(points)] = whole_number(entry[1], "points", t.count);
  }
  const auto magnitudes = [&](const char* name) {
    const json& value = member(j, name, "");
    return at_path(name, [&] { return magnitudes_from_json(value, t.count); });
  };
  for (std::size_t i = 0; i < t.errors.size(); ++i) {
    const ScoreTally::Quantity& quantity = ScoreTally::quantities[i];
    // Files of before the deepest point was measured do without it.
    if (j.contains(quantity.name) || quantity.value != &Score::deepest_error) {
      t.errors[i] = magnitudes(quantity.name);
    }
  }
  // Files of before the sign of the depth error was kept do without it.
  if (j.contains("too_deep")) {
    t.bias.negative = magnitudes("too_deep");
    t.bias.positive = magnitudes("too_shallow");
  }
  t.severity = magnitudes("severity");
  t.coverage.uncovered = magnitudes("uncovered");
  const auto one = static_cast<std::uint64_t>(1 / CoverageTally::unit);
  t.coverage.sum =
      whole_number(member(j, "covered_sum", ""), "covered_sum", t.coverage.uncovered.count() * one);
  for (const json& entry : array(member(j, "worst", ""), "worst")) {
    t.worst.push_back(at_path("worst", [&] { return case_from_json(entry, cell); }));
  }
  t.worst = worst_of_class(std::move(t.worst));
  return t;
}

namespace {

constexpr const char* schema = "touchstone-shard-3";

std::string checksum_line(const std::string& checksum) {
  return json{{"crc32", checksum}}.dump() + '\n';
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
                     "must be a shard file, shard-….jsonl, as there is one beside it");
}

/// What comes before the last line, which must be its checksum.
std::string_view intact(std::string_view text, const std::string& file) {
  const std::size_t last_line =
      text.size() < 2 ? std::string_view::npos : text.rfind('\n', text.size() - 2);
  if (last_line == std::string_view::npos ||
      text.substr(last_line + 1) != checksum_line(checksum(text.substr(0, last_line + 1)))) {
    refuse_result(text, file);
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

/// Each candidate has answered what is done of each class, and nothing else.
void check_counts(const ShardState& p, const std::string& file) {
  const std::vector<std::uint64_t> expected = configurations_by_cell(p.plan.cut, p.done);
  for (std::size_t cell = 0; cell < p.plan.cells.size(); ++cell) {
    for (std::size_t k = 0; k < p.plan.candidates.size(); ++k) {
      const ScoreTally& tally = p.tally(cell, k);
      if (tally.count > expected[cell]) refuse(file, "with counts of more than what is done");
      if (tally.count < expected[cell]) refuse(file, "with counts of less than what is done");
      for (const Case& c : tally.worst) {
        if (c.index >= p.plan.cut.count) refuse(file, "with cases that the campaign has not");
      }
    }
  }
}

/// Takes the first line off a text of whole lines.
std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), line.size() + 1));
  return line;
}

ShardState parsed(std::string_view text, const std::string& file) {
  const json head = parse_json(take_line(text), "line 1");
  if (member(head, "schema", "") != schema) {
    refuse(file, fmt::format("of schema {} and not \"{}\"", shown(head["schema"]), schema));
  }
  const Plan plan = plan_from_json(member(head, "campaign", ""));
  const auto tally_lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  if (plan.candidates.empty() || tally_lines % plan.candidates.size() != 0 ||
      tally_lines / plan.candidates.size() != plan.cells.size()) {
    refuse(file, "without a line for each class and candidate");
  }
  ShardState result(plan, shard_from_json(member(head, "shard", "")));
  result.done = unit_set_from_json(member(head, "done", ""));
  if (!boost::icl::within(result.done, result.shard.units(result.plan.cut))) {
    refuse(file, "with work done that is not its own");
  }
  if (!are_whole_runs(result.plan.cut, result.done)) refuse(file, "with a run done in part");
  for (std::size_t i = 0; i < result.tallies.size(); ++i) {
    const std::string_view line = take_line(text);
    const std::string name = fmt::format("line {}", i + 2);
    result.tallies[i] = at_path(name, [&] {
      const json object = parse_json(line, "it");
      return tally_from_json(member(object, "tally", ""), i / result.plan.candidates.size());
    });
  }
  check_counts(result, file);
  return result;
}

}  // namespace

ShardState::ShardState(Plan of, Shard which)
    : plan(std::move(of)),
      shard(which),
      tallies(plan.cells.size() * plan.candidates.size(), ScoreTally(Precision::binned)) {}

void ShardState::add(const UnitSet& units, const std::vector<ScoreTally>& added) {
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

namespace {

std::string head_line(const ShardState& p) {
  return json{{"schema", schema},
              {"shard", {p.shard.number, p.shard.of}},
              {"done", touchstone::to_json(p.done)},
              {"campaign", json::parse(p.plan.text)}}
             .dump() +
         '\n';
}

std::string tally_line(const ShardState& p, std::size_t cell, std::size_t candidate) {
  return json{{"pair", pair_name(p.plan.cells[cell].pair)},
              {"class", p.plan.cells[cell].name()},
              {"candidate", p.plan.candidates[candidate]},
              {"tally", to_json(p.tally(cell, candidate))}}
             .dump() +
         '\n';
}

}  // namespace

ShardLines::ShardLines(const ShardState& state) : state_(state), lines_(state.tallies.size() + 2) {}

void ShardLines::renew(std::size_t cell) {
  const std::size_t candidates = state_.plan.candidates.size();
  for (std::size_t k = 0; k < candidates; ++k) lines_[1 + cell * candidates + k].clear();
}

const std::vector<std::string>& ShardLines::all() {
  const std::size_t candidates = state_.plan.candidates.size();
  lines_.front() = head_line(state_);
  for (std::size_t i = 0; i < state_.tallies.size(); ++i) {
    std::string& line = lines_[1 + i];
    if (line.empty()) line = tally_line(state_, i / candidates, i % candidates);
  }
  lines_.back() = checksum_line(checksum(std::span(lines_).first(lines_.size() - 1)));
  return lines_;
}

std::string to_text(const ShardState& state) {
  return fmt::format("{}", fmt::join(ShardLines(state).all(), ""));
}

void write_shard(ShardLines& lines, const std::filesystem::path& file) {
  const std::vector<std::string>& all = lines.all();
  write_file(file, {all.begin(), all.end()}, "--out", "make room, then go on with --resume");
}

void write_shard(const ShardState& state, const std::filesystem::path& file) {
  ShardLines lines(state);
  write_shard(lines, file);
}

ShardState read_shard(const std::filesystem::path& file, const char* field) {
  // Of all candidates and classes, 5 KB for each of 86,000 tallies once the histograms fill up.
  constexpr std::size_t max_shard_size = std::size_t{1} << 32;
  std::error_code error;
  const bool ordinary = std::filesystem::is_regular_file(file, error);
  return shard_from_text(read_file(file, field, ordinary ? max_shard_size : max_file_size),
                         file.string());
}

ShardState shard_from_text(const std::string& text, const std::string& file) {
  try {
    return parsed(intact(text, file), file);
  } catch (const InvalidInput& e) {
    if (e.field() == '"' + file + '"') throw;
    refuse(file, fmt::format("not understood ({})", error_text(e)));
  }
}

}  // namespace touchstone
