#include "reports/report_file.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "properties/files/json_fields.hpp"
#include "properties/files/read_file.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Reads members and knows where in which file they stand.
class Reader {
 public:
  Reader(const std::string& file, const json& value, std::string path = "")
      : file_(file), value_(value), path_(std::move(path)) {}

  Reader at(const std::string& name) const {
    if (!value_.is_object()) refuse("must be an object");
    const std::string path = path_.empty() ? name : path_ + '.' + name;
    const auto member = value_.find(name);
    if (member == value_.end()) Reader(file_, nullptr, path).refuse("is missing");
    return {file_, *member, path};
  }
  const Reader& text() const {
    if (!value_.is_string()) refuse("must be a string");
    return *this;
  }
  const Reader& whole() const {
    if (!value_.is_number_unsigned()) refuse("must be a whole number");
    return *this;
  }
  const Reader& number() const {
    if (!value_.is_number()) refuse("must be a number");
    return *this;
  }
  /// An error relative to a size, of which infinity was written as null.
  const Reader& not_negative() const {
    if (!value_.is_number() || !(value_.get<double>() >= 0)) {
      refuse("must be a number that is not negative");
    }
    return *this;
  }
  /// A time, a number of instructions, or the factor between two; quotients of two stay finite.
  const Reader& positive() const {
    constexpr double min = 1e-30, max = 1e30;
    if (!value_.is_number() || !(value_.get<double>() >= min && value_.get<double>() <= max)) {
      refuse("must be a positive number, from 1e-30 to 1e30");
    }
    return *this;
  }
  const Reader& share() const {
    if (!value_.is_number() || !(value_.get<double>() >= 0 && value_.get<double>() <= 1)) {
      refuse("must be a number from 0 to 1");
    }
    return *this;
  }
  const Reader& flag() const {
    if (!value_.is_boolean()) refuse("must be true or false");
    return *this;
  }
  bool is_null() const { return value_.is_null(); }
  const json& value() const { return value_; }
  const json& object() const {
    if (!value_.is_object()) refuse("must be an object");
    return value_;
  }
  template <class Check>
  void each(const Check& check) const {
    if (!value_.is_array()) refuse("must be an array");
    for (std::size_t i = 0; i < value_.size(); ++i) {
      check(Reader(file_, value_[i], path_ + '[' + std::to_string(i) + ']'));
    }
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InvalidInput(file_ + ": " + path_, shown(value_),
                       what + "; make the report again with this version of touchstone");
  }

 private:
  std::string file_;
  const json& value_;
  std::string path_;
};

void check_quantiles(const Reader& q) {
  if (q.is_null()) return;
  for (const char* which : {"median", "p99", "max"}) q.at(which).not_negative();
}

/// Every configuration has one outcome.
void check_outcomes(const Reader& row) {
  constexpr std::uint64_t max_count = std::uint64_t{1} << 53;  // exact as a double
  const Reader count = row.at("count").whole(), outcomes = row.at("outcomes");
  const auto all = count.value().get<std::uint64_t>();
  if (all < 1 || all > max_count) count.refuse("must be positive and at most 2^53");
  std::uint64_t left = all;
  for (const auto& [name, value] : outcomes.object().items()) {
    const auto number = outcomes.at(name).whole().value().get<std::uint64_t>();
    if (number > left) outcomes.refuse("must be numbers whose sum is the count");
    left -= number;
  }
  if (left != 0) outcomes.refuse("must be numbers whose sum is the count");
}

void check_row(const Reader& row) {
  for (const char* name : {"pair", "class", "candidate"}) row.at(name).text();
  check_outcomes(row);
  for (const char* name : {"depth_error", "normal_regret", "point_error"}) {
    check_quantiles(row.at(name));
  }
  // Reports of before the deepest point was measured do without it.
  if (row.value().contains("deepest_error")) check_quantiles(row.at("deepest_error"));
  if (const Reader c = row.at("coverage"); !c.is_null()) c.at("mean").share();
  const Reader time = row.at("nanoseconds");
  if (time.is_null()) return;
  for (const char* name : {"median", "low", "high"}) time.at(name).positive();
  if (const Reader r = time.at("instructions"); !r.is_null()) r.positive();
  if (time.at("ratio_to_bullet").is_null()) return;
  for (const char* name : {"ratio_to_bullet", "ratio_low", "ratio_high"}) time.at(name).positive();
}

void check(const Reader& report) {
  const Reader schema = report.at("schema");
  if (schema.value() != report_schema) {
    schema.refuse("must be " + std::to_string(report_schema));
  }
  report.at("version").text();
  report.at("seed").whole();
  report.at("configurations").whole();
  for (const char* name : {"tolerance", "threshold"}) report.at(name).number();
  report.at("partial").flag();
  for (const char* name : {"cpu", "compiler"}) report.at("machine").at(name).text();
  report.at("candidates").each([](const Reader& c) {
    for (const char* name : {"name", "version", "settings"}) c.at(name).text();
  });
  report.at("results").each(check_row);
  report.at("summary").each([](const Reader& row) {
    check_row(row);
    if (const Reader on_front = row.at("pareto"); !on_front.is_null()) on_front.flag();
  });
}

}  // namespace

json report_from_text(std::string_view text, const std::string& name) {
  json report;
  try {
    report = parse_json(text, "it");
  } catch (const InvalidInput& e) {
    throw InvalidInput("file", '"' + name + '"', std::string("must be a report.json; ") + e.what());
  }
  if (!report.is_object()) {
    throw InvalidInput("file", '"' + name + '"', "must be a report.json: an object");
  }
  check(Reader(name, report));
  return report;
}

json read_report(const std::filesystem::path& file) {
  return report_from_text(read_file(file, "file"), file.string());
}

}  // namespace touchstone
