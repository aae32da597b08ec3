#include "reports/report_file.hpp"

#include <fstream>
#include <string>

#include "reference/invalid_input.hpp"

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
  const Reader& positive() const {
    if (!value_.is_number() || value_.get<double>() <= 0) refuse("must be a positive number");
    return *this;
  }
  const Reader& flag() const {
    if (!value_.is_boolean()) refuse("must be true or false");
    return *this;
  }
  bool is_null() const { return value_.is_null(); }
  const json& value() const { return value_; }
  template <class Check>
  void each(const Check& check) const {
    if (!value_.is_array()) refuse("must be an array");
    for (std::size_t i = 0; i < value_.size(); ++i) {
      check(Reader(file_, value_[i], path_ + '[' + std::to_string(i) + ']'));
    }
  }
  [[noreturn]] void refuse(const std::string& what) const {
    std::string shown = value_.dump(-1, ' ', true, json::error_handler_t::replace);
    if (shown.size() > 60) shown = shown.substr(0, 60) + "…";
    throw InvalidInput(file_ + ": " + path_, shown,
                       what + "; make the report again with this version of touchstone");
  }

 private:
  std::string file_;
  const json& value_;
  std::string path_;
};

void check_quantiles(const Reader& q) {
  if (q.is_null()) return;
  for (const char* which : {"median", "p99", "max"}) q.at(which).number();
}

void check_row(const Reader& row) {
  for (const char* name : {"pair", "class", "candidate"}) row.at(name).text();
  row.at("count").positive();
  const Reader outcomes = row.at("outcomes");
  for (const auto& [name, count] : outcomes.value().items()) outcomes.at(name).whole();
  for (const char* name : {"depth_error", "normal_regret", "point_error"}) {
    check_quantiles(row.at(name));
  }
  // Reports of before the deepest point was measured do without it.
  if (row.value().contains("deepest_error")) check_quantiles(row.at("deepest_error"));
  if (const Reader c = row.at("coverage"); !c.is_null()) c.at("mean").number();
  const Reader time = row.at("nanoseconds");
  if (time.is_null()) return;
  for (const char* name : {"median", "low", "high"}) time.at(name).positive();
  for (const char* name : {"instructions", "ratio_to_bullet", "ratio_low", "ratio_high"}) {
    if (const Reader r = time.at(name); !r.is_null()) r.positive();
  }
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

json read_report(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) {
    throw InvalidInput("file", '"' + file.string() + '"', "could not be opened for reading");
  }
  json report;
  try {
    report = json::parse(in);
  } catch (const json::parse_error& e) {
    throw InvalidInput("file", '"' + file.string() + '"',
                       std::string("must be a report.json, but is no JSON: ") + e.what());
  }
  if (!report.is_object()) {
    throw InvalidInput("file", '"' + file.string() + '"', "must be a report.json: an object");
  }
  check(Reader(file.string(), report));
  return report;
}

}  // namespace touchstone
