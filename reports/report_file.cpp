#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <future>
#include <initializer_list>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"
#include "reports/inconsistency.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// A value with its place in the file. What it is not is refused with both.
class Reader {
 public:
  Reader(const std::string& file, const json& value, std::string path = "")
      : file_(file), value_(value), path_(std::move(path)) {}

  bool has(const std::string& name) const { return value_.is_object() && value_.contains(name); }
  Reader at(const std::string& name) const {
    if (!value_.is_object()) refuse("must be an object");
    const std::string path = path_.empty() ? name : path_ + '.' + name;
    const auto member = value_.find(name);
    if (member == value_.end()) Reader(file_, nullptr, path).refuse("is missing");
    return {file_, *member, path};
  }
  template <class Read>
  void each(const Read& read) const {
    if (!value_.is_array()) refuse("must be an array");
    for (std::size_t i = 0; i < value_.size(); ++i) {
      read(Reader(file_, value_[i], path_ + '[' + std::to_string(i) + ']'));
    }
  }
  bool is_null() const { return value_.is_null(); }
  const json& value() const { return value_; }

  std::string text() const {
    if (!value_.is_string()) refuse("must be a string");
    return readable(value_);
  }
  std::uint64_t whole() const {
    if (!value_.is_number_unsigned()) refuse("must be a whole number");
    return value_;
  }
  double number() const {
    if (!value_.is_number()) refuse("must be a number");
    return value_;
  }
  /// An error relative to a size; infinity was written as null.
  double not_negative() const {
    if (!value_.is_number() || !(value_.get<double>() >= 0)) {
      refuse("must be a number that is not negative");
    }
    return value_;
  }
  /// A time, a number of instructions, or the factor between two; quotients of two stay finite.
  double positive() const {
    constexpr double min = 1e-30, max = 1e30;
    if (!value_.is_number() || !(value_.get<double>() >= min && value_.get<double>() <= max)) {
      refuse("must be a positive number, from 1e-30 to 1e30");
    }
    return value_;
  }
  double share() const {
    if (!value_.is_number() || !(value_.get<double>() >= 0 && value_.get<double>() <= 1)) {
      refuse("must be a number from 0 to 1");
    }
    return value_;
  }
  bool flag() const {
    if (!value_.is_boolean()) refuse("must be true or false");
    return value_;
  }
  const json& object() const {
    if (!value_.is_object()) refuse("must be an object");
    return value_;
  }
  /// The whole file, which is of another kind.
  [[noreturn]] void refuse_file(const std::string& why) const {
    throw InvalidInput("file", '"' + file_ + '"',
                       "must be the report.json of touchstone report, but " + why);
  }
  [[noreturn]] void refuse(const std::string& what) const { refuse({path_, shown(value_), what}); }
  /// What is found at a place of the whole file.
  [[noreturn]] void refuse(const Inconsistency& found) const {
    throw InvalidInput(file_ + ": " + found.place, found.value,
                       found.remedy + "; make the report again with this version of touchstone");
  }

 private:
  std::string file_;
  const json& value_;
  std::string path_;
};

/// Refuses numbers of an object that do not ascend in this order. An older report is without some.
void require_ascending(const Reader& of, std::initializer_list<const char*> names) {
  const char* before = nullptr;
  for (const char* name : names) {
    if (!of.has(name)) continue;
    if (before && of.at(name).number() < of.at(before).number()) {
      of.at(name).refuse(
          fmt::format("must not be less than its {}, {}", before, shown(of.at(before).value())));
    }
    before = name;
  }
}

std::optional<Quantiles> read_quantiles(const Reader& q) {
  if (q.is_null()) return std::nullopt;
  const Quantiles result{q.at("median").not_negative(), q.at("p99").not_negative(),
                         q.at("max").not_negative()};
  require_ascending(q, {"median", "p99", "max"});
  return result;
}
/// Older reports are without some of them.
std::optional<Quantiles> quantiles_if_any(const Reader& row, const char* name) {
  return row.has(name) ? read_quantiles(row.at(name)) : std::nullopt;
}

/// Numbers by outcome that add up to `sum`.
OutcomeCounts outcome_counts(const Reader& outcomes, std::uint64_t sum) {
  OutcomeCounts result{};
  for (const auto& [name, value] : outcomes.object().items()) {
    const Reader number = outcomes.at(name);
    const auto outcome = find_outcome(name);
    if (!outcome) number.refuse("must belong to an outcome");
    const std::uint64_t count = number.whole();
    if (count > sum) outcomes.refuse("must be numbers whose sum is the count");
    sum -= count;
    result[static_cast<std::size_t>(*outcome)] = count;
  }
  if (sum != 0) outcomes.refuse("must be numbers whose sum is the count");
  return result;
}

void read_outcomes(const Reader& row, Statistics& statistics) {
  constexpr std::uint64_t max_count = std::uint64_t{1} << 53;  // exact as a double
  const Reader count = row.at("count");
  statistics.count = count.whole();
  if (statistics.count < 1 || statistics.count > max_count) {
    count.refuse("must be positive and at most 2^53");
  }
  statistics.outcomes = outcome_counts(row.at("outcomes"), statistics.count);
}

std::optional<Shares> shares(const Reader& coverage) {
  if (coverage.is_null()) return std::nullopt;
  Shares result{coverage.at("mean").share(), 0, 0, 0};
  for (const auto& [name, value] : {std::pair("median", &result.median),
                                    std::pair("p1", &result.p1), std::pair("min", &result.min)}) {
    *value = coverage.has(name) ? coverage.at(name).share() : result.mean;
  }
  require_ascending(coverage, {"min", "p1", "median"});
  return result;
}

Spread spread(const Reader& time, const char* median, const char* low, const char* high) {
  const Spread result{time.at(median).positive(), time.at(low).positive(),
                      time.at(high).positive()};
  require_ascending(time, {low, median, high});
  return result;
}

std::optional<QueryTime> query_time(const Reader& time) {
  if (time.is_null()) return std::nullopt;
  QueryTime result{.nanoseconds = spread(time, "median", "low", "high")};
  if (time.has("repetitions")) result.repetitions = time.at("repetitions").whole();
  if (time.has("p95") && !time.at("p95").is_null()) result.p95 = time.at("p95").number();
  if (const Reader n = time.at("instructions"); !n.is_null()) result.instructions = n.positive();
  if (!time.at("ratio_to_bullet").is_null()) {
    result.ratio_to_bullet = spread(time, "ratio_to_bullet", "ratio_low", "ratio_high");
  }
  return result;
}

ResultRow result_row(const Reader& row) {
  ResultRow result;
  result.pair = row.at("pair").text();
  result.pose_class = row.at("class").text();
  result.candidate = row.at("candidate").text();
  Statistics& s = result.statistics;
  read_outcomes(row, s);
  s.depth_error = read_quantiles(row.at("depth_error"));
  s.normal_regret = read_quantiles(row.at("normal_regret"));
  s.point_error = read_quantiles(row.at("point_error"));
  s.deepest_error = quantiles_if_any(row, "deepest_error");
  if (row.has("bias") && !row.at("bias").is_null()) {
    s.bias = SignedMedian{row.at("bias").at("median").number()};
  }
  s.coverage = shares(row.at("coverage"));
  result.time = query_time(row.at("nanoseconds"));
  return result;
}

ResultRow summary_row(const Reader& row) {
  ResultRow result = result_row(row);
  if (const Reader on_front = row.at("pareto"); !on_front.is_null()) {
    result.pareto = on_front.flag();
  }
  return result;
}

Machine machine(const Reader& m) {
  Machine result;
  result.cpu = m.at("cpu").text();
  result.compiler = m.at("compiler").text();
  if (m.has("os")) result.os = m.at("os").text();
  if (m.has("cores")) result.cores = static_cast<unsigned>(m.at("cores").whole());
  return result;
}

PoseClassDescription pose_class(const Reader& c) {
  PoseClassDescription result;
  result.pair = c.at("pair").text();
  result.pose_class = c.at("class").text();
  if (c.has("group")) result.group = c.at("group").text();  // schema 1 knows none
  if (c.has("digest")) result.digest = c.at("digest").text();
  return result;
}

Report report(const Reader& r) {
  const Reader schema = r.at("schema");
  // Other files of ours name what they are.
  if (schema.value().is_string()) r.refuse_file("has schema " + shown(schema.value()));
  constexpr int old_schema = 1, schema_of_old_judge = 2;
  Report result;
  result.is_old = schema.value() == old_schema;
  result.is_of_old_judge = result.is_old || schema.value() == schema_of_old_judge;
  if (!result.is_of_old_judge && schema.value() != report_schema) {
    schema.refuse(
        fmt::format("must be {}, {} or {}", old_schema, schema_of_old_judge, report_schema));
  }
  result.version = r.at("version").text();
  result.seed = r.at("seed").whole();
  result.configurations = r.at("configurations").whole();
  result.tolerance = r.at("tolerance").not_negative();
  result.threshold = r.at("threshold").not_negative();
  result.partial = r.at("partial").flag();
  result.machine = machine(r.at("machine"));
  r.at("candidates").each([&](const Reader& c) {
    CandidateDescription& candidate = result.candidates.emplace_back();
    candidate.name = c.at("name").text();
    candidate.version = c.at("version").text();
    candidate.settings = c.at("settings").text();
    if (c.has("runs")) candidate.runs = c.at("runs").text();  // older ones are all native
  });
  if (r.has("classes")) {
    r.at("classes").each([&](const Reader& c) { result.classes.push_back(pose_class(c)); });
  }
  r.at("results").each([&](const Reader& row) {
    result.results.push_back(result_row(row));
    ResultRow& added = result.results.back();
    const auto today = find_pose_class(added.pair, added.pose_class);
    if (result.is_old && today) added.pose_class = today->name();
  });
  // An old summary is over all groups, which no summary is any more.
  if (!result.is_old) {
    r.at("summary").each([&](const Reader& row) { result.summary.push_back(summary_row(row)); });
  }
  if (const auto found = inconsistency(result)) r.refuse(*found);
  return result;
}

}  // namespace

Report report_from_text(std::string_view text, const std::string& name) {
  json parsed;
  try {
    parsed = parse_json(text, "it");
  } catch (const InvalidInput& e) {
    throw InvalidInput("file", '"' + name + '"', std::string("must be a report.json; ") + e.what());
  }
  if (!parsed.is_object()) {
    throw InvalidInput("file", '"' + name + '"', "must be a report.json: an object");
  }
  return report(Reader(name, parsed));
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
