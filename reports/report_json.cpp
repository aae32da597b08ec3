#include "reports/report_json.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/json_members.hpp"
#include "reports/report_members.hpp"

namespace touchstone {

using nlohmann::json;

json to_json(const Machine& machine) { return object_of(machine); }
json to_json(const PoseClassDescription& c) { return object_of(c); }
json to_json(const ResultRow& row) { return object_of(row); }
json to_json(const Factor& f) { return object_of(f); }
json to_json(const Contrast& c) { return object_of(c); }
json to_json(const History& history) { return object_of(history); }
json to_json(const WorstCase& worst) { return object_of(worst); }
json to_json(const Examination& examination) { return object_of(examination); }

json summary_json(const Report& report) {
  json rows = json::array();
  for (const ResultRow& row : report.summary) rows.push_back(object_of(SummaryRow{row}));
  return rows;
}

json to_json(const TruthOf& of) {
  return to_json(of.examination->configuration, *of.examination->truth);
}

json to_json(const AnswersOf& of) {
  json result = json::object();
  for (const auto& [candidate, answer, score] : of.examination->answers) {
    result[candidate] = to_json(answer, score);
  }
  return result;
}

json to_json(const Report& report) {
  json result = object_of(report);
  result["schema"] = report_schema;
  return result;
}

std::string text_by_lines(const json& object) {
  std::string text;
  for (const auto& [name, value] : object.items()) {
    text += (text.empty() ? "{\n" : ",\n") + json(name).dump() + ": ";
    if (!value.is_array() || value.empty()) {
      text += value.dump();
      continue;
    }
    const char* before = "[\n";
    for (const json& entry : value) text += std::exchange(before, ",\n") + entry.dump();
    text += "\n]";
  }
  return text + "\n}\n";
}

}  // namespace touchstone
