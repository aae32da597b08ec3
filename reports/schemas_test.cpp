// docs/*.schema.json say of every file what the types say from which it is written, and what each
// member means: descriptions stand in these files alone. TOUCHSTONE_WRITE_SCHEMA=1 writes the
// schemas anew and keeps the descriptions that they have.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

#include <nlohmann/json.hpp>

#include "properties/files/disk.hpp"
#include "properties/files/json_schema_test.hpp"
#include "reports/compare.hpp"
#include "reports/report_json.hpp"
#include "reports/stability/stability_members.hpp"

namespace touchstone {
namespace {

using nlohmann::ordered_json;

ordered_json reference(const std::string& to) { return {{"$ref", to}}; }

/// What stands in solve.schema.json, and numbers that a function writes.
void set_what_is_known(JsonSchema& schema) {
  const std::string solve = "solve.schema.json#/$defs/";
  schema.set<Configuration>(reference(solve + "configuration"));
  schema.set<TruthOf>(reference(solve + "truth"));
  schema.set<AnswersOf>(reference(solve + "answers"));
  schema.set<Outcome>(reference(solve + "outcome"));
  schema.set<ShortNumber>({{"type", "number"}});
}

/// A whole file: an object that begins with these members. The file itself has its description.
ordered_json file(const char* title, ordered_json object, const ordered_json& definitions,
                  const ordered_json& first = ordered_json::object()) {
  ordered_json properties = first, required = ordered_json::array();
  for (const auto& [name, value] : first.items()) required.push_back(name);
  properties.update(object["properties"]);
  required.insert(required.end(), object["required"].begin(), object["required"].end());
  object["properties"] = properties, object["required"] = required;
  ordered_json result = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                         {"title", title},
                         {"description", ""}};
  result.update(object);
  if (!definitions.empty()) result["$defs"] = definitions;
  return result;
}
ordered_json constant(const ordered_json& value) { return {{"const", value}}; }
const ordered_json a_text = {{"type", "string"}};

ordered_json report_schema_json() {
  JsonSchema schema({"histogram", "truth", "answers"},
                    {"median_bounds", "p99_bounds", "p1_bounds"});
  set_what_is_known(schema);
  schema.define<Machine>("machine");
  schema.define<CandidateDescription>("candidate");
  schema.define<PoseClassDescription>("class");
  schema.define<Quantiles>("quantiles");
  schema.define<ErrorStatistics>("errors");
  schema.define<SignedMedian>("bias");
  schema.define<Shares>("shares");
  schema.define<QueryTime>("time");
  schema.define<ResultRow>("result");
  schema.define<SummaryRow>("summary");
  schema.define<FailureRate>("rate");
  schema.define<Factor>("factor");
  schema.define<Contrast>("contrast");
  schema.define<Trend>("trend");
  schema.define<RecordedShare>("recorded");
  schema.define<DrakeProtocol>("drake_protocol");
  schema.define<Casts>("casts");
  schema.define<WorstCase>("worst");
  schema.set<Stability>(reference("stability.schema.json#/$defs/stability"));
  schema.set<ExperimentResults>(reference("experiments.schema.json"));
  schema.set<EngineResults>(reference("engines.schema.json"));
  const ordered_json object = schema.object(Report());
  return file("report.json of touchstone report, schema 3", object, schema.definitions(),
              {{"schema", constant(report_schema)}});
}

ordered_json campaign_schema_json() {
  JsonSchema schema({"median_bounds", "p99_bounds", "p1_bounds"},
                    {"histogram", "truth", "answers"});
  set_what_is_known(schema);
  const std::string report = "report.schema.json#/$defs/";
  schema.set<PoseClassDescription>(reference(report + "class"));
  schema.set<Factor>(reference(report + "factor"));
  schema.set<Contrast>(reference(report + "contrast"));
  schema.set<QueryTime>({{"type", "null"}});  // campaigns do not time candidates
  schema.define<Bounds>("bounds");
  schema.define<Quantiles>("quantiles");
  schema.define<ErrorStatistics>("quantiles");  // without histograms they are the same
  schema.define<SignedMedian>("bias");
  schema.define<Shares>("shares");
  schema.define<WorstCase>("worst");
  const ordered_json whole = schema.of<std::uint64_t>();
  ordered_json row = schema.object(ResultRow());
  row["properties"]["count"] = whole;  // zero of what a partial campaign has not come to
  ordered_json summary = row;
  summary["properties"]["pair"] = schema.of<std::string>(rule::pair_or_all);
  summary["properties"]["class"] = schema.of<std::string>(rule::group);
  ordered_json candidate = {{"type", "object"}};
  for (const char* name : {"name", "family", "version", "settings", "models", "plugin_checksum"}) {
    candidate["properties"][name] = a_text;
    candidate["required"].push_back(name);
  }
  candidate["properties"]["plugin_checksum"]["pattern"] = "^[0-9a-f]{8}$";
  candidate["additionalProperties"] = false;
  const ordered_json first = {{"schema", constant("touchstone-campaign-3")},
                              {"version", a_text},
                              {"command", a_text},
                              {"seed", whole},
                              {"count", whole},
                              {"tolerance", schema.of<double>(rule::positive)},
                              {"threshold", schema.of<double>(rule::not_negative)},
                              {"configurations", whole},
                              {"complete", schema.of<bool>()},
                              {"candidates", {{"type", "array"}, {"items", candidate}}},
                              {"classes", schema.of<std::vector<PoseClassDescription>>()},
                              {"results", {{"type", "array"}, {"items", row}}},
                              {"summary", {{"type", "array"}, {"items", summary}}},
                              {"factors", schema.of<std::vector<Factor>>()},
                              {"contrasts", schema.of<std::vector<Contrast>>()},
                              {"worst", schema.of<std::vector<WorstCase>>()}};
  const ordered_json rest = {{"type", "object"},
                             {"properties", ordered_json::object()},
                             {"required", ordered_json::array()},
                             {"additionalProperties", false}};
  return file("campaign.json of touchstone campaign and merge", rest, schema.definitions(), first);
}

ordered_json stability_schema_json() {
  JsonSchema schema({}, {});
  set_what_is_known(schema);
  schema.define<Amplification>("amplification");
  schema.define<FailureMaps>("maps");
  schema.define<Sequences>("sequences");
  schema.define<Sequences::Peak>("peak");
  const ordered_json object = schema.object(Stability());
  ordered_json definitions = schema.definitions();
  definitions["stability"] = object;
  return file(
      "stability.json of touchstone stability", object, definitions,
      {{"schema", constant("touchstone-stability-1")}, {"version", a_text}, {"command", a_text}});
}

ordered_json comparison_schema_json() {
  JsonSchema schema({}, {});
  schema.set<Machine>(reference("report.schema.json#/$defs/machine"));
  schema.define<Comparison::Side>("side");
  const ordered_json object = schema.object(Comparison());
  return file("touchstone compare --json", object, schema.definitions(),
              {{"schema", constant("touchstone-comparison-1")}});
}

/// A result with such an outcome.
ordered_json result_schema(JsonSchema& schema,
                           const std::vector<ExperimentResult::Outcome>& outcomes) {
  ExperimentResult sample;
  sample.outcome = outcomes[0];
  ordered_json result = schema.object(sample);
  ordered_json& names = result["properties"]["outcome"]["enum"] = ordered_json::array();
  for (const auto outcome : outcomes) names.push_back(name_of(outcome));
  return result;
}

ordered_json experiments_schema_json() {
  using Outcome = ExperimentResult::Outcome;
  JsonSchema schema({}, {});
  schema.define<ExperimentDescription>("experiment");
  schema.set<ExperimentResult>(reference("#/$defs/any_result"));
  const ordered_json object = schema.object(ExperimentResults());
  ordered_json definitions = schema.definitions();
  definitions["any_result"]["oneOf"] = {
      result_schema(schema, {Outcome::measured, Outcome::unsound}),
      result_schema(schema, {Outcome::unsupported}),
      result_schema(schema, {Outcome::crashed, Outcome::timed_out})};
  return file("touchstone simulate --json, of experiments; a report's member experiments", object,
              definitions);
}

ordered_json engines_schema_json() {
  JsonSchema schema({}, {});
  const std::string experiments = "experiments.schema.json#/$defs/";
  schema.set<ExperimentDescription>(reference(experiments + "experiment"));
  schema.set<ExperimentResult>(reference(experiments + "any_result"));
  const ordered_json object = schema.object(EngineResults());
  return file("engines.json of touchstone simulate --engine; a report's member engines", object,
              schema.definitions());
}

struct Written {
  const char* name;
  ordered_json (*schema)();
};
std::ostream& operator<<(std::ostream& out, const Written& file) { return out << file.name; }

const std::vector<Written> all_written = {
    {"report", report_schema_json},           {"campaign", campaign_schema_json},
    {"stability", stability_schema_json},     {"comparison", comparison_schema_json},
    {"experiments", experiments_schema_json}, {"engines", engines_schema_json}};

class Schemas : public testing::TestWithParam<Written> {};

std::filesystem::path path_of(const std::string& name) {
  return std::filesystem::path(TOUCHSTONE_DOCS) / (name + ".schema.json");
}
std::string contents(const std::string& name) { return read_file(path_of(name), "file"); }

/// Gives a schema the descriptions that another one has in the same places.
void describe(ordered_json& schema, const ordered_json& described) {
  for (const auto& [key, value] : schema.items()) {
    if (schema.is_object() && !described.contains(key)) continue;
    if (schema.is_array() && std::stoul(key) >= described.size()) continue;
    const ordered_json& same = schema.is_array() ? described[std::stoul(key)] : described.at(key);
    if (value.is_structured() && value.type() == same.type()) describe(value, same);
  }
  // A member of this name is an object.
  const auto description = described.find("description");
  if (description != described.end() && description->is_string()) {
    schema["description"] = *description;
  }
}

TEST_P(Schemas, AreWhatTheTypesSay) {
  ordered_json schema = GetParam().schema();
  describe(schema, ordered_json::parse(contents(GetParam().name)));
  if (std::getenv("TOUCHSTONE_WRITE_SCHEMA")) {
    std::ofstream(path_of(GetParam().name)) << schema_text(schema);
  }
  EXPECT_EQ(contents(GetParam().name), schema_text(schema));
}

INSTANTIATE_TEST_SUITE_P(, Schemas, testing::ValuesIn(all_written),
                         [](const auto& file) { return std::string(file.param.name); });

/// Names of the members of all objects, or of those with a description.
void insert_names(std::set<std::string>& names, const ordered_json& schema, bool described_alone) {
  for (const auto& [key, value] : schema.items()) {
    if (key == "properties" && value.is_object()) {
      for (const auto& [member, of_member] : value.items()) {
        if (!described_alone || of_member.contains("description")) names.insert(member);
      }
    }
    if (value.is_structured()) insert_names(names, value, described_alone);
  }
}

struct Described {
  const char* name;
  std::vector<const char*> elsewhere;  ///< files that describe further members by their names
};

TEST(AllSchemas, DescribeEveryMember) {
  const std::vector<Described> all = {{"report", {}},
                                      {"campaign", {"report"}},
                                      {"stability", {"report"}},
                                      {"comparison", {"report"}},
                                      {"experiments", {"report"}},
                                      {"engines", {"experiments", "report"}},
                                      {"solve", {}},
                                      {"choose", {"report"}}};
  for (const Described& file : all) {
    const ordered_json schema = ordered_json::parse(contents(file.name));
    std::set<std::string> names, described;
    insert_names(names, schema, false);
    insert_names(described, schema, true);
    for (const char* other : file.elsewhere) {
      insert_names(described, ordered_json::parse(contents(other)), true);
    }
    EXPECT_GT(names.size(), 10) << file.name;
    for (const std::string& name : names) {
      EXPECT_TRUE(described.contains(name)) << file.name << ": " << name;
    }
  }
}

}  // namespace
}  // namespace touchstone
