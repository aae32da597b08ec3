#include "reports/report_page.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reports/pages/page.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

bool same_keys(const json& a, const json& b) {
  return std::equal(a.items().begin(), a.items().end(), b.items().begin(), b.items().end(),
                    [](const auto& l, const auto& r) { return l.key() == r.key(); });
}

/// The schema that all of these values fit, null among them or not.
json schema_of(const std::vector<const json*>& values) {
  std::vector<const json*> present;
  for (const json* v : values) {
    if (!v->is_null()) present.push_back(v);
  }
  if (present.empty()) return nullptr;
  const json& first = *present.front();
  const auto all = [&](const auto& holds) {
    return std::all_of(present.begin(), present.end(), [&](const json* v) { return holds(*v); });
  };
  if (present.size() == values.size() && all([](const json& v) { return v.is_string(); })) {
    return "string";
  }
  if (!all([&](const json& v) { return v.is_object() && same_keys(v, first); })) return nullptr;
  json result = json::object();
  for (const auto& [key, unused] : first.items()) {
    std::vector<const json*> members;
    for (const json* v : present) members.push_back(&v->at(key));
    result[key] = schema_of(members);
  }
  return result;
}

class Packer {
 public:
  json list(const json& objects) {
    std::vector<const json*> all;
    for (const json& o : objects) all.push_back(&o);
    const json schema = schema_of(all);
    json rows = json::array();
    for (const json& o : objects) rows.push_back(value(o, schema));
    return {{"schema", schema}, {"rows", rows}};
  }
  const json& strings() const { return strings_; }

 private:
  json value(const json& v, const json& schema) {
    if (v.is_null() || schema.is_null()) return rounded(v);
    if (schema.is_string()) {
      const auto [at, is_new] = numbers_.try_emplace(v.get<std::string>(), strings_.size());
      if (is_new) strings_.push_back(v);
      return at->second;
    }
    json row = json::array();
    for (const auto& [key, of_member] : schema.items()) row.push_back(value(v.at(key), of_member));
    return row;
  }

  static json rounded(const json& v) {
    if (v.is_number_float()) {
      return std::strtod(fmt::format("{:.4g}", v.get<double>()).c_str(), nullptr);
    }
    json result = v;
    if (v.is_structured()) {
      for (json& member : result) member = rounded(member);
    }
    return result;
  }

  std::map<std::string, std::size_t> numbers_;
  json strings_ = json::array();
};

}  // namespace

json packed(const json& report) {
  json result = report;
  Packer packer;
  for (const char* list : {"results", "summary", "trends"}) {
    if (report.contains(list)) result[list] = packer.list(report[list]);
  }
  result["strings"] = packer.strings();
  return result;
}

std::string report_page(const Report& report) {
  json data = packed(to_json(report));
  std::vector<std::string> names;
  for (const CandidateDescription& c : report.candidates) names.push_back(c.name);
  data["marks"] = marks(names);
  return render_page(Page::report, data);
}

}  // namespace touchstone
