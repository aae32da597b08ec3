#include "reports/solve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reports/small_report_test.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::vector<json> solved(const std::string& input, bool& good) {
  std::istringstream in(input);
  std::stringstream out;
  good = solve(in, out, {some_configurations().candidates, 1e-15, Bar()});
  std::vector<json> lines;
  for (std::string line; std::getline(out, line);) lines.push_back(json::parse(line));
  return lines;
}

const std::string on_sphere =
    R"({"id":"c1","a":{"shape":"cylinder","radius":0.5,"half_length":1},"pose_a":{"position":[0,0,1.5]},"b":{"shape":"sphere","radius":1}})";

TEST(Solve, AnswersOneLineWithOne) {
  bool good = false;
  const auto lines = solved(on_sphere, good);  // no newline at the end
  EXPECT_TRUE(good);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0]["id"], "c1");
  const auto end = [&](int i) {
    return std::stod(lines[0]["truth"]["signed_distance"][i].get<std::string>());
  };
  EXPECT_LE(end(0), -0.5);
  EXPECT_GE(end(1), -0.5);
  EXPECT_NEAR(end(0), end(1), 1e-15);
  EXPECT_EQ(lines[0]["truth"]["normals"], json::array({{0.0, 0.0, 1.0}}));
  EXPECT_EQ(lines[0]["answers"]["bullet"]["status"], "contact");
  EXPECT_EQ(lines[0]["answers"]["reference"]["score"]["outcome"], "agree");
}

TEST(Solve, GivesAPatchForEveryNormal) {
  bool good = false;
  json line = json::parse(on_sphere);
  EXPECT_EQ(solved(on_sphere, good)[0]["truth"]["patch"][0]["kind"], "point");
  line["b"] = json::parse(R"({"shape":"box","half_extents":[2,2,0.75]})");
  const json truth = solved(line.dump(), good)[0]["truth"];
  ASSERT_EQ(truth["patch"].size(), truth["normals"].size());
  EXPECT_EQ(truth["patch"][0]["kind"], "region");
  EXPECT_NEAR(truth["patch"][0]["area"].get<double>(), 0.7853981633974483, 1e-14);
  EXPECT_NEAR(truth["patch"][0]["centroid"][2].get<double>(), 0.625, 1e-14);
  EXPECT_EQ(truth["patch"][0]["outline"].size(), 32u);
}

TEST(Solve, NormalsPointFromTheUsersBToTheUsersA) {
  json line = json::parse(on_sphere);
  std::swap(line["a"], line["b"]);
  line["pose_b"] = line["pose_a"];
  line.erase("pose_a");
  bool good = false;
  const auto lines = solved(line.dump(), good);
  EXPECT_EQ(lines[0]["truth"]["normals"][0][2], -1.0);
  EXPECT_EQ(lines[0]["answers"]["reference"]["normal"][2], -1.0);
  EXPECT_EQ(lines[0]["answers"]["reference"]["points"][0]["normal"][2], -1.0);
  EXPECT_EQ(lines[0]["answers"]["reference"]["score"]["outcome"], "agree");
}

TEST(Solve, ABadLineIsNamedAndTheRestGoOn) {
  bool good = true;
  const std::string bad =
      R"({"id":7,"a":{"shape":"cylinder","radius":-1,"half_length":1},"b":{"shape":"sphere","radius":1}})";
  const auto lines =
      solved(on_sphere + "\r\n\n" + bad + "\nnonsense\n\xff\n[]\n" + on_sphere + "\n", good);
  EXPECT_FALSE(good);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_TRUE(lines[0].contains("truth"));
  EXPECT_EQ(lines[1]["line"], 3);
  EXPECT_EQ(lines[1]["id"], 7);
  EXPECT_EQ(lines[1]["field"], "a.radius");
  EXPECT_THAT(lines[1]["error"].get<std::string>(), HasSubstr("-1"));
  EXPECT_EQ(lines[2]["line"], 4);
  EXPECT_EQ(lines[3]["line"], 5);
  EXPECT_EQ(lines[4]["line"], 6);
  EXPECT_EQ(lines[5]["truth"], lines[0]["truth"]);
}

TEST(Solve, GivesBackEveryScalarAsAnIdAndRefusesOthers) {
  bool good = true;
  json line = json::parse(on_sphere);
  for (const json& id : {json("c1"), json(7), json(1.5), json(true), json()}) {
    line["id"] = id;
    const auto lines = solved(line.dump(), good);
    EXPECT_TRUE(good) << id;
    EXPECT_EQ(lines[0].at("id"), id);
  }
  line["id"] = {1, 2};
  const auto lines = solved(line.dump(), good);
  EXPECT_FALSE(good);
  EXPECT_EQ(lines[0]["field"], "id");
  EXPECT_FALSE(lines[0].contains("id"));
}

TEST(Solve, RefusesWhatOnlyBeginsAsAConfiguration) {
  const std::string twice =
      R"({"a":{"shape":"cylinder","radius":1,"radius":2,"half_length":1},"b":{"shape":"sphere","radius":1}})";
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "{\"a\":";
  bool good = true;
  const auto lines = solved(on_sphere + '\0' + "x\n" + twice + '\n' + deep + '\n' +
                                std::string(3000000, ' ') + on_sphere + '\n' + on_sphere + '\n',
                            good);
  EXPECT_FALSE(good);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0]["field"], "line");
  EXPECT_EQ(lines[1]["field"], "a.radius");
  EXPECT_THAT(lines[2]["error"].get<std::string>(), HasSubstr("nested too deeply"));
  EXPECT_THAT(lines[3]["error"].get<std::string>(), HasSubstr("at most"));
  EXPECT_TRUE(lines[4].contains("truth"));
  for (const json& line : lines) EXPECT_LT(line.value("error", "").size(), 500U);
}

// cli/tests/solve_test.sh asks a candidate with a memory.
TEST(Solve, WritesTheSameWhateverTheNumberOfWorkers) {
  std::string input;
  json line = json::parse(on_sphere);
  line["b"] = json::parse(R"({"shape":"box","half_extents":[1,1,0.75]})");
  for (int i = 0; i < 600; ++i) {
    line["id"] = i;
    line["pose_a"]["position"] = {1e-3 * i, 0, 1.7};
    line["pose_a"]["axis"] = {0.001 * (i % 7), 0, 1};
    input += (i == 300 ? "nonsense" : line.dump()) + '\n';
  }
  for (const bool csv : {false, true}) {
    const auto written = [&](unsigned workers) {
      std::istringstream in(input);
      std::ostringstream out;
      EXPECT_FALSE(solve(in, out,
                         {.candidates = find_candidates({"bullet-persistent"}),
                          .width = 1e-15,
                          .bar = {},
                          .workers = workers,
                          .csv = csv}));
      return out.str();
    };
    const std::string one = written(1);
    EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), csv ? 601 : 600);
    EXPECT_TRUE(written(3) == one) << (csv ? "CSV" : "JSON");
  }
}

TEST(Solve, WritesARowOfCsvForEachLineAndCandidate) {
  json line = json::parse(on_sphere);
  line["id"] = "a \"long\", long id";
  json swapped = json::parse(on_sphere);
  std::swap(swapped["a"], swapped["b"]);
  swapped["pose_b"] = swapped["pose_a"];
  swapped.erase("pose_a");
  swapped["id"] = 2;
  std::istringstream in(line.dump() + "\n\n" + swapped.dump() + "\n{\"id\":null}\n");
  std::stringstream out;
  EXPECT_FALSE(solve(in, out,
                     {.candidates = find_candidates({"reference", "bullet"}),
                      .width = 1e-15,
                      .bar = {},
                      .csv = true}));
  std::vector<std::string> rows;
  for (std::string row; std::getline(out, row);) rows.push_back(row);
  ASSERT_EQ(rows.size(), 6U) << out.str();
  EXPECT_THAT(rows[0], testing::StartsWith("line,id,candidate,signed_distance,"));
  const std::string length = R"(-0\.5,[0-9.e-]+,-0\.5[0-9]*,-0\.(5|49)[0-9]*,unique,)";
  EXPECT_THAT(rows[1], testing::MatchesRegex(R"re(1,"a ""long"", long id",reference,)re" + length +
                                             "0.0 0.0 1.0,contact,-0\\.5,0.0 0.0 1.0,1,agree,.*"));
  EXPECT_THAT(rows[2], testing::HasSubstr(",bullet,"));
  EXPECT_THAT(rows[3], testing::StartsWith("3,2,reference,-0.5,"));
  EXPECT_THAT(rows[3], testing::HasSubstr("-1.0,contact,"));
  EXPECT_EQ(rows[5].substr(0, 7), "4,null,");
  EXPECT_THAT(rows[5], testing::HasSubstr("a is missing: must be given"));
  for (const std::string& row : {rows[0], rows[3], rows[4]}) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 21) << row;
  }
}

TEST(Solve, EndsWhereItsAnswersAreLost) {
  std::istringstream in(on_sphere + '\n' + on_sphere + '\n' + on_sphere + '\n');
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  solve(in, out, {some_configurations().candidates, 1e-15, Bar()});
  std::string rest;
  EXPECT_TRUE(std::getline(in, rest)) << "all lines were answered to nobody";
}

}  // namespace
}  // namespace touchstone
