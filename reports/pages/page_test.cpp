#include "reports/pages/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/npm_engines.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/findings.hpp"
#include "reports/pages/page_data.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/small_report_test.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(ReportPage, CarriesTheReport) {
  Report report;
  report.command = "é ≤ /* report.js */ $& \\u003c";
  report.tolerance = 0.1;
  report.candidates = {{"ode", "ODE", "1", "", ""}};
  json data = data_of(report_page(report)), expected = to_json(report);
  EXPECT_EQ(data["marks"], json({{"ode", {2, 0}}}));
  EXPECT_EQ(data["program"], "./touchstone");
  EXPECT_EQ(data["findings"], json::array());
  for (const char* const of_the_page_alone : {"program", "marks", "findings"}) {
    data.erase(of_the_page_alone);
  }
  EXPECT_EQ(data, expected);
}

TEST(ReportPage, HasTheFindingsOfTheTerminal) {
  const json said = data_of(report_page(report_of_some()))["findings"];
  const std::vector<Finding> expected = findings(report_of_some());
  ASSERT_GE(expected.size(), 2u);
  ASSERT_EQ(said.size(), expected.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_EQ(said[i]["candidate"], expected[i].candidate);
    EXPECT_EQ(said[i]["text"], expected[i].text);
    EXPECT_EQ(said[i]["command"], expected[i].command);
  }
}

TEST(ReportPage, SaysOfWhichClassesAFewQueriesTakeMuchLonger) {
  Report report;
  for (const double p95 : {399.0, 401.0}) {
    ResultRow& row = report.results.emplace_back();
    row.time = QueryTime{.nanoseconds = {100, 99, 101}, .p95 = p95};
  }
  const json rows = data_of(report_page(report))["results"];
  EXPECT_FALSE(rows[0].contains("has_slow_tail"));
  EXPECT_EQ(rows[1]["has_slow_tail"], true);
}

TEST(ReportPage, ShowsWhatWouldTurnTheDirectionOfALineAsDigits) {
  Report report;
  report.command = "touchstone report --out left\u202ethgir";
  const std::string page = report_page(report);
  EXPECT_EQ(page.find("\u202e"), page.npos);
  EXPECT_EQ(data_of(page)["command"], "touchstone report --out left\\u202ethgir");
}

TEST(ReportPage, RoundsRowsToFourDigits) {
  Report report;
  report.summary.emplace_back().statistics.severity = Quantiles{1.0 / 3, 1.0 / 3, 1.0 / 3};
  EXPECT_EQ(data_of(report_page(report))["summary"][0]["severity"]["median"], 0.3333);
}

TEST(Marks, AreAnEnginesColourAndASettingsSymbol) {
  EXPECT_EQ(mark_of("bullet-float").colour, mark_of("bullet").colour);
  EXPECT_NE(mark_of("bullet-float").symbol, mark_of("bullet").symbol);
  EXPECT_NE(mark_of("ode").colour, mark_of("bullet").colour);
  EXPECT_EQ(mark_of("prism:8").symbol, mark_of("prism:64").symbol);
  EXPECT_EQ(mark_of("my-engine").colour, 7u);
  std::set<std::pair<std::size_t, std::size_t>> seen;
  std::set<std::size_t> colours;
  for (const NpmEngine& engine : npm_engines()) {
    const Mark mark = mark_of(engine.family);
    EXPECT_TRUE(seen.insert({mark.colour, mark.symbol}).second) << engine.family;
    EXPECT_NE(mark.colour, 7u) << engine.family;
    colours.insert(mark.colour);
  }
  EXPECT_EQ(colours.size(), 5u);  // jolt, rapier, physx, havok, mujoco3
  EXPECT_LT(mark_of("").symbol, 6u);
}

TEST(ReportPage, HostileStringsStayData) {
  for (const char* text : {"</script><script>alert(1)</script>", "<!--<script>", "]]>"}) {
    Report report;
    report.command = text;
    const std::string page = report_page(report);
    EXPECT_EQ(data_of(page)["command"], text);
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  }
}

std::string page_of(const Identity& identity) {
  const Subject s = subject(identity);
  return replay_page(examine(s, {}, Bar{}), s.description);
}

std::vector<Identity> one_of_each_class() {
  std::vector<Identity> result;
  for (const Pair pair : all_pairs) {
    for (const auto& pose_class : pose_classes(pair)) result.push_back({pair, pose_class, 3, 1});
  }
  return result;
}

TEST(ReplayPage, HoldsEveryNumberThreeTimes) {
  for (const Identity& identity : one_of_each_class()) {
    const Configuration c = make_configuration(identity);
    const json data = data_of(page_of(identity));
    EXPECT_EQ(data["id"], to_string(identity));
    EXPECT_EQ(data["configuration"], to_json(c));
    EXPECT_EQ(data["hexadecimal"], to_hex_json(c));
    EXPECT_EQ(data["exact"], to_exact_json(c));
    EXPECT_FALSE(data["truth"]["normals"].empty());
  }
}

std::vector<std::string> both_pages() {
  return {report_page({}), page_of({Pair::box, "rim-face", 1, 2})};
}

TEST(Pages, LoadNothingFromElsewhere) {
  for (std::string page : both_pages()) {
    // The browser is told to refuse all requests, also those that Vega could make.
    EXPECT_THAT(page, HasSubstr("content=\"default-src 'none'; "));
    // The one address is the SVG namespace, a name that is never fetched.
    const std::string svg = "'http://www.w3.org/2000/svg'";
    page.erase(page.find(svg), svg.size());
    for (const char* way : {"http:", "https:", "src=", "@import", "url(", "fetch("}) {
      EXPECT_EQ(page.find(way), std::string::npos) << way;
    }
  }
}

TEST(Pages, HaveNoPlaceholderLeft) {
  for (const std::string& page : both_pages()) {
    for (const char* name :
         {"title", "pages", "heading", "main", "motion", "vega", "scripts", "data"}) {
      EXPECT_THAT(page, Not(HasSubstr("/* " + std::string(name))));
    }
  }
}

TEST(ReplayPage, HostileReasonsStayData) {
  Examination hostile = examine(subject({Pair::box, "rim-face", 1, 2}), {}, Bar{});
  const std::string reason = "</script><script>alert(1)</script>";
  hostile.answers.push_back({"x", {{}, reason, {}}, {}});
  const std::string page = replay_page(hostile, "");
  EXPECT_EQ(data_of(page)["answers"]["x"]["reason"], reason);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
}

}  // namespace
}  // namespace touchstone
