#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/disk.hpp"
#include "properties/files/json_members.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"
#include "reports/report_json.hpp"
#include "reports/report_members.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

using Key = std::tuple<std::string, std::string, std::string>;  // pair, class or group, candidate
using CountByClass = std::map<std::pair<std::string, std::string>, std::uint64_t>;

Key key_of(const ResultRow& row) { return {row.pair, row.pose_class, row.candidate}; }

/// Has it no more values than this? The sum of its counts may overflow.
bool has_at_most(const LogHistogram& histogram, std::uint64_t most) {
  std::vector<std::uint64_t> counts = histogram.counts;
  counts.push_back(histogram.zero);
  return std::ranges::all_of(counts, [&](std::uint64_t n) {
    const bool fits = n <= most;
    most -= std::min(n, most);
    return fits;
  });
}

/// Finds a contradiction between the rows of one list; adds to `counts` how many configurations
/// each class has.
std::optional<InvalidInput> between_rows(const Report& report, const std::vector<ResultRow>& rows,
                                         const std::string& list, CountByClass& counts) {
  std::set<std::string> candidates;
  for (const CandidateDescription& c : report.candidates) candidates.insert(c.name);
  std::set<Key> seen;
  for (const ResultRow& row : rows) {
    const std::string place = fmt::format("{}[{}]", list, &row - rows.data()),
                      of_class = row.pair + '/' + row.pose_class;
    const auto about_candidate = [&](const std::string& remedy) {
      return InvalidInput{place + ".candidate", '"' + row.candidate + '"', remedy};
    };
    if (!candidates.contains(row.candidate)) {
      return about_candidate("must be one of the candidates of the report");
    }
    if (!seen.insert(key_of(row)).second) {
      return about_candidate("must have one row for " + of_class);
    }
    const std::uint64_t count = row.statistics.count;
    const auto [of_others, is_first] = counts.try_emplace({row.pair, row.pose_class}, count);
    if (of_others->second != count) {
      return InvalidInput{
          place + ".count", std::to_string(count),
          fmt::format("must be {}, as in the first row of {}", of_others->second, of_class)};
    }
    for (const auto& [name, histogram] :
         {std::pair("depth_error", &row.statistics.depth_histogram),
          std::pair("normal_regret", &row.statistics.regret_histogram)}) {
      if (!*histogram || has_at_most(**histogram, count)) continue;
      return InvalidInput{fmt::format("{}.{}.histogram", place, name), "of more values",
                          fmt::format("must be of at most {}, the count", count)};
    }
  }
  return std::nullopt;
}

/// The outcomes of each pair × group × candidate, and of all pairs together, by the results.
std::map<Key, OutcomeCounts> sums_of_groups(const Report& report) {
  std::map<std::pair<std::string, std::string>, std::string> groups;
  for (const PoseClassDescription& c : report.classes) groups[{c.pair, c.pose_class}] = c.group;
  std::map<Key, OutcomeCounts> sums;
  for (const ResultRow& row : report.results) {
    const std::string& group = groups[{row.pair, row.pose_class}];
    for (const std::string& pair : {row.pair, std::string("all")}) {
      OutcomeCounts& sum = sums[{pair, group, row.candidate}];
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += row.statistics.outcomes[i];
    }
  }
  return sums;
}

/// The first contradiction within a report that was read, if there is one: a candidate or a row
/// twice (of which only one would be compared), a row of no candidate, candidates that answered
/// different numbers of configurations, or a sum that is another one. Its field is the place in the
/// file ("results[3].count").
std::optional<InvalidInput> inconsistency(const Report& report) {
  std::set<std::string> names;
  for (const CandidateDescription& c : report.candidates) {
    if (names.insert(c.name).second) continue;
    return InvalidInput{fmt::format("candidates[{}].name", &c - report.candidates.data()),
                        '"' + c.name + '"', "must stand there once"};
  }
  std::set<std::pair<std::string, std::string>> classes;
  for (const PoseClassDescription& c : report.classes) {
    if (classes.insert({c.pair, c.pose_class}).second) continue;
    return InvalidInput{fmt::format("classes[{}].class", &c - report.classes.data()),
                        '"' + c.pose_class + '"', "must stand there once for " + c.pair};
  }
  for (const ResultRow& row : report.results) {
    // Older reports do not list them, or by older names.
    if (report.is_old || classes.empty() || classes.contains({row.pair, row.pose_class})) continue;
    return InvalidInput{fmt::format("results[{}].class", &row - report.results.data()),
                        '"' + row.pose_class + '"', "must be one of the classes of " + row.pair};
  }
  CountByClass of_classes, of_groups;
  if (auto found = between_rows(report, report.results, "results", of_classes)) return found;
  if (auto found = between_rows(report, report.summary, "summary", of_groups)) return found;
  std::uint64_t configurations = 0;
  for (const auto& [name, count] : of_classes) configurations += count;
  if (!report.is_old && configurations != report.configurations) {
    return InvalidInput{"configurations", std::to_string(report.configurations),
                        fmt::format("must be {}, the sum of all classes", configurations)};
  }
  if (report.classes.empty()) return std::nullopt;  // which group a class belongs to is not known
  auto sums = sums_of_groups(report);
  for (const ResultRow& row : report.summary) {
    const OutcomeCounts &sum = sums[key_of(row)], &said = row.statistics.outcomes;
    const auto [of_sum, other] = std::mismatch(sum.begin(), sum.end(), said.begin());
    if (of_sum == sum.end()) continue;
    return InvalidInput{fmt::format("summary[{}].outcomes.{}", &row - report.summary.data(),
                                    outcome_name(all_outcomes[of_sum - sum.begin()])),
                        std::to_string(*other),
                        fmt::format("must be {}, the sum of its classes", *of_sum)};
  }
  return std::nullopt;
}

Report report(const json& file) {
  const JsonIn in(file);
  const json schema = in.at("schema").value();
  constexpr int old_schema = 1, schema_of_old_judge = 2;
  Report result;
  result.is_old = schema == old_schema;
  result.is_of_old_judge = result.is_old || schema == schema_of_old_judge;
  in.require(result.is_of_old_judge || schema == report_schema, "schema",
             fmt::format("must be {}, {} or {}", old_schema, schema_of_old_judge, report_schema));
  members(in, result);
  for (ResultRow& row : result.results) {
    const auto today = find_pose_class(row.pair, row.pose_class);
    if (result.is_old && today) row.pose_class = today->name();
  }
  if (const auto found = inconsistency(result)) throw *found;
  return result;
}

}  // namespace

Report report_from_text(std::string_view text, const std::string& name) {
  const auto refuse_file = [&](const std::string& must) {
    throw InvalidInput("file", '"' + name + '"', must);
  };
  json parsed;
  try {
    parsed = parse_json(text, "it");
  } catch (const InvalidInput& e) {
    refuse_file(std::string("must be a report.json; ") + e.what());
  }
  if (!parsed.is_object()) refuse_file("must be a report.json: an object");
  // Other files of ours name what they are.
  if (const json schema = parsed.value("schema", json()); schema.is_string()) {
    refuse_file("must be the report.json of touchstone report, but has schema " + shown(schema));
  }
  try {
    return report(parsed);
  } catch (const InvalidInput& e) {
    throw InvalidInput(name + ": " + e.field(), e.value(),
                       e.remedy() + "; make the report again with this version of touchstone");
  }
}

Report read_report(const std::filesystem::path& file) {
  return report_from_text(read_file(file, "file"), file.string());
}

void write_report(const Report& report, const std::filesystem::path& folder) {
  check_writable(folder);
  auto page = std::async(std::launch::async, [&] { return report_page(report); });
  write_file(folder / "report.json", text_by_lines(to_json(report)), "--out");
  write_file(folder / "report.html", page.get(), "--out");
}

}  // namespace touchstone
