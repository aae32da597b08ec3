#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"
#include "reports/make_report.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class ReportFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file); }
  void write(const std::string& text) const { std::ofstream(file) << text; }
  void expect_refusal(const std::string& field, const std::string& why) const {
    EXPECT_THAT([&] { read_report(file); },
                testing::ThrowsMessage<InvalidInput>(
                    AllOf(HasSubstr(file.string()), HasSubstr(field), HasSubstr(why))));
  }
  static json good() {
    static const json report = [] {
      Campaign c{.pairs = {Pair::plane},
                 .classes = {"lying"},
                 .candidates = find_candidates({"reference", "bullet", "libccd-mpr"}),
                 .count = 2};
      return to_json(make_report(c, "x"));
    }();
    return report;
  }
  const std::filesystem::path file =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
};

TEST_F(ReportFile, NoNameMakesALineOfItsOwnOrTurnsAround) {
  json report = good();
  const json name = "ode\nreference  100.0 \u202e";
  report["candidates"][0]["name"] = name;
  for (const char* const list : {"results", "summary"}) {
    for (json& row : report[list]) {
      if (row["candidate"] == "reference") row["candidate"] = name;
    }
  }
  write(report.dump());
  EXPECT_EQ(read_report(file).candidates[0].name, "ode reference  100.0    ");
}

TEST_F(ReportFile, NoHistogramHasMoreValuesThanThereAre) {
  json report = good();
  json& histogram = report["results"][1]["depth_error"]["histogram"];
  histogram["zero"] = 0;
  histogram["counts"] = {1, 1};
  write(report.dump());
  EXPECT_EQ(read_report(file).results[1].statistics.depth_histogram->count(), 2u);
  histogram["counts"] = {1, 2};
  write(report.dump());
  expect_refusal("results[1].depth_error.histogram", "must be of at most 2, the count");
  histogram["counts"] = {1, 0xffffffffffffffffU};
  write(report.dump());
  expect_refusal("results[1].depth_error.histogram", "must be of at most 2, the count");
}

TEST_F(ReportFile, OfBeforeSamplesWentIsReadWithoutWhatTheyStoodFor) {
  json report = good();
  json& row = report["results"][0];
  for (json* const r : {&row, &report["summary"][0]}) {
    (*r)["outcomes"] = {{"agree", 1}, {"not-asked", 1}};
    (*r)["represented"] = {{"agree", 1}};
  }
  write(report.dump());
  const Statistics s = read_report(file).results[0].statistics;
  EXPECT_TRUE(s.is_stopped());
  EXPECT_EQ(s.asked(), 1u);
  EXPECT_EQ(s.agreement(), 0.5);
}

TEST_F(ReportFile, IsReadAsItWasWritten) {
  write(good().dump());
  const json read = to_json(read_report(file)), written = good();
  for (const char* member : {"schema", "version", "seed", "tolerance", "threshold", "machine",
                             "configurations", "partial"}) {
    EXPECT_EQ(read[member], written[member]) << member;
  }
  ASSERT_EQ(read["candidates"].size(), 3u);
  for (const char* member : {"name", "version", "settings"}) {
    EXPECT_EQ(read["candidates"][1][member], written["candidates"][1][member]) << member;
  }
  for (const char* list : {"results", "summary"}) {
    ASSERT_EQ(read[list].size(), written[list].size());
    for (std::size_t i = 0; i < read[list].size(); ++i) {
      const json &row = read[list][i], &written_row = written[list][i];
      for (const char* member : {"pair", "class", "candidate", "count", "outcomes", "point_error",
                                 "deepest_error", "bias", "coverage", "nanoseconds"}) {
        EXPECT_EQ(row[member], written_row[member]) << list << ' ' << i << ' ' << member;
      }
      for (const char* member : {"depth_error", "normal_regret"}) {
        if (written_row[member].is_null()) continue;
        EXPECT_EQ(row[member]["p99"], written_row[member]["p99"]) << list << ' ' << i;
      }
      EXPECT_EQ(row.value("pareto", json()), written_row.value("pareto", json()));
    }
  }
}

TEST_F(ReportFile, NamesTheFileThatIsNone) {
  expect_refusal("file", "could not be opened");
  write("{\"schema\": 1,");
  expect_refusal("file", "is no JSON");
  write("[]");
  expect_refusal("file", "an object");
}

// Of two rows about the same one would be lost, and with it what it tells.
TEST_F(ReportFile, HasOneRowOfEachOfItsCandidates) {
  for (const char* const list : {"results", "summary"}) {
    json report = good();
    report[list].push_back(report[list][0]);
    write(report.dump());
    expect_refusal(list + std::string("[3].candidate is \"reference\""),
                   "must have one row for cylinder-plane/");
    report = good();
    report[list][1]["candidate"] = "another";
    write(report.dump());
    expect_refusal(list + std::string("[1].candidate is \"another\""),
                   "must be one of the candidates");
  }
}

TEST_F(ReportFile, NamesTheFieldAndTheRemedy) {
  const struct {
    const char* pointer;
    json value;
    const char *field, *why;
  } faults[] = {
      {"/schema", 99, "schema is 99", "must be 1, 2 or 3; make the report again"},
      {"/results/1/depth_error/p99", "small", "results[1].depth_error.p99 is \"small\"",
       "must be a number"},
      {"/results/0/nanoseconds/low", 0, "results[0].nanoseconds.low is 0", "positive"},
      {"/results/0/deepest_error",
       {{"median", 0}, {"p99", "small"}, {"max", 1}},
       "results[0].deepest_error.p99",
       "must be a number"},
      {"/results", 3, "results is 3", "must be an array"},
      // Which JSON has null for.
      {"/results/0/count", std::numeric_limits<double>::infinity(), "results[0].count",
       "whole number"},
      // What cannot be compared.
      {"/results/0/outcomes", 3, "results[0].outcomes", "must be"},
      {"/results/0/outcomes", nullptr, "results[0].outcomes is null", "must be"},
      {"/results/0/outcomes", json::array(), "results[0].outcomes", "must be"},
      {"/results/0/outcomes/agree", 0, "results[0].outcomes", "must be"},
      {"/results/0/outcomes/lost", 0, "results[0].outcomes.lost", "must be"},
      {"/results/0/outcomes/missed", std::uint64_t{1} << 63, "results[0].outcomes", "must be"},
      {"/results/0/count", 0, "results[0].count", "must be"},
      {"/results/0/class", "cone", "results[0].class is \"cone\"", "must be"},
      {"/results/0/pair", "cone-cone", "results[0].class is ", "must be"},
      {"/tolerance", -1, "tolerance is -1", "must be"},
      {"/threshold", -1, "threshold is -1", "must be"},
      {"/results/0/coverage/mean", 1.5, "results[0].coverage.mean", "must be"},
      {"/results/0/depth_error/max", -1, "results[0].depth_error.max", "must be"},
      {"/results/0/nanoseconds/ratio_low", nullptr, "results[0].nanoseconds.ratio_low", "must be"},
      {"/results/0/nanoseconds/median", 1e-300, "results[0].nanoseconds.median", "must be"}};
  for (const auto& [pointer, value, field, why] : faults) {
    json report = good();
    report[json::json_pointer(pointer)] = value;
    write(report.dump());
    expect_refusal(field, why);
  }
  json report = good();
  report["results"][0].erase("point_error");
  write(report.dump());
  expect_refusal("results[0].point_error", "is missing");
}

TEST_F(ReportFile, RefusesNumbersThatContradictEachOther) {
  const auto refused = [&](const std::map<std::string, json>& values, const std::string& why) {
    json report = good();
    for (const auto& [pointer, value] : values) report[json::json_pointer(pointer)] = value;
    write(report.dump());
    expect_refusal("", why);
  };
  const auto ascending = [&](const std::string& object, const std::vector<std::string>& names) {
    for (std::size_t i = 1; i < names.size(); ++i) {
      std::map<std::string, json> values;
      for (const std::string& name : names) values[object + '/' + name] = 0.5;
      values[object + '/' + names[i]] = 0.25;
      refused(values,
              fmt::format("{} is 0.25: must not be less than its {}, 0.5", names[i], names[i - 1]));
    }
  };
  for (const char* const row : {"/results/1", "/summary/1"}) {
    for (const char* const errors :
         {"/depth_error", "/normal_regret", "/point_error", "/deepest_error"}) {
      ascending(std::string(row) + errors, {"median", "p99", "max"});
    }
    ascending(std::string(row) + "/coverage", {"min", "p1", "median"});
    ascending(std::string(row) + "/nanoseconds", {"low", "median", "high"});
    ascending(std::string(row) + "/nanoseconds", {"ratio_low", "ratio_to_bullet", "ratio_high"});
  }
  refused({{"/candidates/1/name", "reference"}},
          "candidates[1].name is \"reference\": must stand there once");
  refused({{"/classes/1", good()["classes"][0]}},
          "classes[1].class is \"lying\": must stand there once for cylinder-plane");
  refused({{"/configurations", 3}}, "configurations is 3: must be 2, the sum of all classes");
  refused({{"/results/1/count", 1}, {"/results/1/outcomes", {{"agree", 1}}}},
          "results[1].count is 1: must be 2, as in the first row of cylinder-plane/lying");
  refused({{"/summary/0/outcomes", {{"agree", 1}, {"missed", 1}}}},
          "summary[0].outcomes.agree is 1: must be 2, the sum of its classes");
}

TEST_F(ReportFile, RefusesTextThatOnlyBeginsAsAReport) {
  std::string text = good().dump();
  write(text + '\0');
  expect_refusal("is no JSON", "whole JSON value");
  write(text.replace(text.find("\"seed\":") + 7, 1, "1e400"));
  expect_refusal("seed is a number beyond all doubles", "1.8e308");
  text = good().dump();
  write("{\"seed\":1," + text.substr(1));
  expect_refusal("seed is given twice", "once");
}

}  // namespace
}  // namespace touchstone
