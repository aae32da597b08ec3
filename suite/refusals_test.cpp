// Files that are none: a reader says in one line where and what is wrong.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "properties/files/disk.hpp"
#include "suite/readers_test.hpp"
#include "suite/touchstone_suite.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Files, and what both judges have to say of them.
struct Refusal {
  std::string suite, answers, expected;
};

/// Reads the files with each judge's functions, one process for all of them.
void expect_refusals(const OwnFolder& folder, const std::vector<Refusal>& refusals) {
  json files = json::array();
  for (const auto& [suite, answers, expected] : refusals) files.push_back({suite, answers});
  const std::string list = folder.with("list.json", files.dump()).string();
  for (const char* const command : {TOUCHSTONE_PYTHON R"( -Bc '
import json, os, judge
for suite, answers in json.load(open(os.environ["LIST"])):
    try: judge.read_answers(answers, {case["id"]: case for case in judge.read(suite)}); print("used")
    except ValueError as e: print(e)')",
                                    R"(node -e '
const {read, readAnswers} = require("./judge.js");
for (const [suite, answers] of JSON.parse(require("fs").readFileSync(process.env.LIST)))
  try { readAnswers(answers, new Map(read(suite).map(c => [c.id, c]))); console.log("used"); }
  catch (e) { console.log(e.message); }')"}) {
    std::istringstream said(printed_by("cd " TOUCHSTONE_SUITE " && LIST=" + list + ' ' + command));
    std::string line;
    for (const auto& [suite, answers, expected] : refusals) {
      ASSERT_TRUE(std::getline(said, line)) << command << expected;
      EXPECT_THAT(line, testing::HasSubstr(expected)) << command;
    }
    EXPECT_FALSE(std::getline(said, line)) << line;
  }
}

/// As programs, judges say it in one line, with exit code 2.
void expect_refusal(const std::string& files, const std::string& expected) {
  for (const std::string& judge : judges) {
    SCOPED_TRACE(judge + files);
    const std::string said = printed_by("{ " + judge + files + " 2>&1; echo \"exit $?\"; }");
    EXPECT_THAT(said, testing::HasSubstr(expected));
    EXPECT_THAT(said, testing::EndsWith("\nexit 2\n"));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2) << said;
  }
}

template <class Read>
std::string refusal_in_cpp(const std::string& csv, const Read& read) {
  std::istringstream in(csv);
  try {
    return std::to_string(read(in, "given").size()) + " cases";
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, text.npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(Readers, RefuseASuiteThatIsCutOffDamagedOrNone) {
  const OwnFolder folder;
  const std::string answer =
      folder.with("answers", R"({"id": "cylinder-box/recorded/1/13", "status": "none"})");
  const std::string first = unpacked("1"), second = unpacked("2-smoke"),
                    casts = unpacked("2-casts");
  const struct {
    std::string csv, judges_say, cpp_says;
  } damaged[] = {
      {"", ":1: must be the columns", "1: nothing can be read"},
      {"a,b\n1,2\n", ":1: must be the columns", "1: must be the columns"},
      {first.substr(0, 100000), ":147: has 18 cells: must have 35", "147: position_b_z is missing"},
      {first.substr(0, first.rfind('\n', first.size() - 2) + 1),
       ": has 5105 configurations: must have 5106", " has 5105 configurations: must have 5106"},
      {replaced(second, "0.65625", "O.65625"), ":3: radius_a is \"O.65625\": must be a number",
       "3: radius_a is \"O.65625\": must be a number"},
      {replaced(second, "0.65625", "0,65625"), ":3: has 39 cells: must have 38",
       "3: size_b_1 is \"plane\": must be a number"},
      {second.substr(0, second.rfind("cylinder-convex")), ":61: must be \"# 59 configurations\"",
       "61: must be \"# 59 configurations\""},
      {casts.substr(0, casts.rfind("cylinder-convex")), ":141: must be \"# 139 configurations\"",
       "141: must be \"# 139 configurations\""},
      {replaced(casts, ",0.25,0.5,", ",0.25,half,"),
       ":3: half_length_a is \"half\": must be a number",
       "3: half_length_a is \"half\": must be a number"},
      {replaced(casts, "required,2.5e-05", "required,none"),
       ":3: tolerance is \"none\": must be a number",
       "3: tolerance is \"none\": must be a number"}};
  std::vector<Refusal> refusals;
  for (const auto& [csv, judges_say, cpp_says] : damaged) {
    const std::string name = std::to_string(refusals.size()) + ".csv";
    refusals.push_back({folder.with(name, csv), answer, name + judges_say});
    const bool is_casts = csv.find("sweep_x") != csv.npos;
    EXPECT_THAT(is_casts ? refusal_in_cpp(csv, touchstone_suite::read_casts)
                         : refusal_in_cpp(csv, touchstone_suite::read),
                testing::StartsWith("given:" + cpp_says));
  }
  const std::string bytes = read_file(suite_file("1"), "file");
  EXPECT_THAT(refusal_in_cpp(bytes, touchstone_suite::read),
              testing::EndsWith("unpack a .gz by gzip -d"));
  EXPECT_THAT(refusal_in_cpp(second, touchstone_suite::read_casts),
              testing::HasSubstr("given:1: must be the columns of casts"));
  std::ifstream missing((folder.path / "none.csv").string());
  EXPECT_THROW(touchstone_suite::read(missing), std::runtime_error);
  refusals.push_back({folder.with("packed.csv", bytes), answer, "packed.csv:"});
  refusals.push_back(
      {folder.with("cut.csv.gz", bytes.substr(0, 50000)), answer, "cut.csv.gz: cannot be read: "});
  refusals.push_back({folder.path / "none.csv", answer, "none.csv: cannot be read: "});
  expect_refusals(folder, refusals);
  expect_refusal(refusals[0].suite + ' ' + answer, "0.csv:1: must be the columns");
  expect_refusal("--float " + suite_file("1") + ' ' + answer, "has no float_tolerance");
}

TEST(Readers, RefuseAnswersThatAreNoneAndNameTheLineAndTheField) {
  const std::string id = R"({"id": "cylinder-plane/general+apart/2/0")";
  const std::string good = id + R"(, "status": "none"})" + '\n';
  const std::string contact = good + id + R"(, "status": "contact")";
  const std::string byte_order_mark = "\xef\xbb\xbf";  // which may stand before the first line
  const std::string cast = R"({"id": "cylinder-plane/near", "status": )";
  const struct {
    std::string answers, expected, suite = "2-smoke";
  } none_of_these[] = {
      {"", ": has no answers"},
      {R"({"candidate": "mine"})", ": has no answers"},
      {"[1]", ":1: is no object"},
      {good + "hello", ":2: is not JSON ("},
      {byte_order_mark + good + "hello", ":2: is not JSON ("},
      {good + byte_order_mark + good, ":2: is not JSON ("},
      {good + R"({"status": "none"})", ":2: id is missing"},
      {R"({"id": "mine/1", "status": "none"})",
       ":1: id is \"mine/1\": must be that of a configuration"},
      {R"({"id": true, "status": "none"})", ":1: id is true: must be that of a configuration"},
      {R"({"id": [], "status": "none"})", ":1: id is []: must be that of a configuration"},
      {id + "}", ":1: status is missing: must be \"contact\", \"none\" or"},
      {contact + "}", ":2: signed_distance is missing: must be a number"},
      {contact + R"(, "signed_distance": -1, "points": []})",
       ":2: normal is missing: must be [x, y, z]"},
      {contact + R"(, "signed_distance": "-1", "normal": [0, 0, 1], "points": []})",
       ":2: signed_distance is not usable: must be a number"},
      {contact + R"(, "signed_distance": -1, "normal": [0, 1], "points": []})",
       ":2: normal is not usable"},
      {contact + R"(, "signed_distance": -1, "normal": [0, 0, 1]})", ":2: points is missing"},
      {contact + R"(, "signed_distance": -1, "normal": [0, 0, 1], "points": [{"depth": 1}]})",
       ":2: points is not usable"},
      {cast + "3}", ":1: status is missing: must be \"touch\", \"from-start\", \"never\" or",
       "2-casts"},
      {cast + R"("none"})", ":1: status is \"none\": must be \"touch\", ", "2-casts"},
      {id + R"(, "status": "never"})", ":1: status is \"never\": must be \"contact\", "},
      {cast + R"("touch"})", ":1: fraction is missing: must be a number", "2-casts"},
      {cast + R"("touch", "fraction": "half", "normal": [0, 0, 1]})",
       ":1: fraction is not usable: must be a number", "2-casts"},
      {cast + R"("touch", "fraction": 0.5})", ":1: normal is missing: must be [x, y, z]",
       "2-casts"},
      {cast + R"("from-start"})", ":1: normal is missing: must be [x, y, z]", "2-casts"}};
  const OwnFolder folder;
  std::vector<Refusal> refusals;
  for (const auto& [answers, expected, suite] : none_of_these) {
    const std::string name = "answers-" + std::to_string(refusals.size());
    refusals.push_back({suite_file(suite), folder.with(name, answers), name + expected});
  }
  expect_refusals(folder, refusals);
  expect_refusal(refusals[3].suite + ' ' + refusals[3].answers, ":2: is not JSON (");
}

}  // namespace
}  // namespace touchstone
