// The suites: that the committed files are those that `touchstone export --suite` and `--suite-2`
// write, cover what they say, and that their three readers judge answers as the scores of our
// reports do.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/numbers.hpp"
#include "reports/test_data/given_answers.hpp"
#include "reports/test_data/test_data.hpp"
#include "suite/readers_test.hpp"
#include "suite/touchstone_suite.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

const std::string& committed() {
  static const std::string text = unpacked("1");
  return text;
}

const std::vector<TestDatum>& data() {
  static const std::vector<TestDatum> all = [] {
    Campaign campaign = suite_1();
    campaign.workers = 2;
    std::vector<TestDatum> result;
    make_test_data(campaign, [&](const TestDatum& datum) { result.push_back(datum); });
    return result;
  }();
  return all;
}

const std::vector<touchstone_suite::Case>& cases_read() {
  static const auto all = [] {
    std::istringstream in(committed());
    return touchstone_suite::read(in);
  }();
  return all;
}

TEST(Suite1, IsWhatExportWritesToTheByte) {
  const auto writer = test_data_writer(TestDataFormat::csv, CsvColumns::suite);
  std::string text;
  for (const TestDatum& datum : data()) text += writer->add(datum);
  text += writer->finish();
  ASSERT_EQ(text.size(), committed().size());
  EXPECT_TRUE(text == committed());
}

TEST(Suites, HaveTheChecksumsThatAreWrittenDown) {
  const std::string sums = read_file(TOUCHSTONE_SUITE "/SHA256SUMS", "file");
  EXPECT_EQ(sums,
            printed_by("cd " TOUCHSTONE_SUITE " && for f in touchstone-suite-1 "
                       "touchstone-suite-2-smoke touchstone-suite-2-everyday "
                       "touchstone-suite-2-hard touchstone-suite-2-casts; do sha256sum $f.csv.gz; "
                       "gzip -dc $f.csv.gz | sha256sum | sed \"s/-$/$f.csv/\"; done"));
  EXPECT_THAT(read_file(TOUCHSTONE_SUITE "/README.md", "file"),
              testing::HasSubstr(sums.substr(0, 64)));
}

TEST(Suite1, IsSmallEnoughForARepository) {
  EXPECT_LT(std::filesystem::file_size(suite_file("1")), 1500000u);
  EXPECT_NEAR(static_cast<double>(data().size()), 5000, 500);
}

TEST(Suite1, HasEveryPoseClassAndEveryKindOfAnswer) {
  std::set<std::pair<Pair, std::string>> classes;
  std::set<std::string> groups, contacts, ties;
  for (const TestDatum& d : data()) {
    const PoseClass& c = d.identity.pose_class;
    classes.insert({c.pair, c.name()});
    groups.insert(group_name(c.group()));
    contacts.insert(contact_name(d.limits.contact));
    ties.insert(ties_name(d.truth.ties));
  }
  std::size_t count = 0;
  for (const Pair pair : all_pairs) count += pose_classes(pair, Coverage::suite_1).size();
  EXPECT_EQ(classes.size(), count);
  EXPECT_EQ(groups.size(), std::size(all_groups));
  EXPECT_EQ(contacts.size(), 3u);
  EXPECT_EQ(ties.size(), 3u);
}

/// Bound of the error of a reader's gap, relative to the largest regret allowed; README.md has it.
constexpr double gap_error = 0.01;

/// Rotations of the best normal for which every reader has to know the regret: to all sides, and
/// far enough that the reversed term of a plane's column counts.
constexpr double angles[] = {0, 1e-3, -1e-3, 0.5, 2, -2};

Vec3 rotated_best(const TestDatum& d, double angle) {
  const Vec3 best = d.truth.normals.front().n;
  const Vec3 axis = best.unitOrthogonal() + best.cross(best.unitOrthogonal()) / 2;
  return Eigen::AngleAxisd(angle, axis.normalized()) * best;
}

/// Holds the gaps that a reader says for all data and angles, in order, to the exact regrets.
void expect_gaps(const std::vector<TestDatum>& given,
                 const std::vector<touchstone_suite::Case>& cases,
                 const std::vector<double>& gaps) {
  ASSERT_EQ(gaps.size(), given.size() * std::size(angles));
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const TestDatum& d = given[i / std::size(angles)];
    const touchstone_suite::Case& c = cases[i / std::size(angles)];
    const double angle = angles[i % std::size(angles)];
    const double expected = oracle::normal_regret(d.configuration, d.truth, rotated_best(d, angle));
    // Beyond the limit only the verdict counts: an error relative to the regret.
    EXPECT_NEAR(std::max(0.0, c.signed_distance - gaps[i]), expected,
                std::max(gap_error * c.max_regret, 1e-12 * expected))
        << c.id << ' ' << angle;
  }
}

/// The gaps of the reader in C++, and of those in Python and JavaScript, which are given a file.
void expect_gaps_of_all_readers(const std::vector<TestDatum>& given, const std::string& csv) {
  std::istringstream in(csv);
  const auto cases = touchstone_suite::read(in);
  ASSERT_EQ(cases.size(), given.size());
  std::vector<double> by_cpp;
  json normals = json::array();
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (const double angle : angles) {
      const Vec3 n = rotated_best(given[i], angle);
      by_cpp.push_back(touchstone_suite::gap(cases[i], {n.x(), n.y(), n.z()}));
      normals.push_back({n.x(), n.y(), n.z()});
    }
  }
  expect_gaps(given, cases, by_cpp);
  const OwnFolder folder;
  folder.with("suite.csv", csv);
  folder.with("normals.json", normals.dump());
  const std::string count = std::to_string(std::size(angles));
  const auto said_by = [&](const std::string& command) {
    return json::parse(printed_by("cd " TOUCHSTONE_SUITE " && FOLDER=" + folder.path.string() +
                                  ' ' + command))
        .get<std::vector<double>>();
  };
  expect_gaps(given, cases, said_by(TOUCHSTONE_PYTHON R"( -Bc '
import json, os, judge
folder = os.environ["FOLDER"]
normals = iter(json.load(open(folder + "/normals.json")))
print([judge.gap(case, next(normals)) for case in judge.read(folder + "/suite.csv")
       for _ in range()" + count + R"()])')"));
  expect_gaps(given, cases,
              said_by(R"(node -e '
const {read, gap} = require("./judge.js"), folder = process.env.FOLDER;
const normals = JSON.parse(require("fs").readFileSync(folder + "/normals.json"));
const cases = read(folder + "/suite.csv");
console.log(JSON.stringify(normals.map((n, i) => gap(cases[Math.floor(i / )" +
                      count + R"()], n))));')"));
}

TEST(Suite1, ReadersKnowTheRegretOfAnyNormal) { expect_gaps_of_all_readers(data(), committed()); }

/// The suite's planes all have unit normals, so that these are not in it.
TEST(Readers, KnowPlanesWhoseNormalsHaveAnyLength) {
  // With the suite's columns alone it would have to be the whole suite.
  const auto writer = test_data_writer(TestDataFormat::csv, CsvColumns::all);
  std::vector<TestDatum> made;
  std::string csv;
  for (const TestDatum& d : data()) {
    const auto* const plane = std::get_if<Plane>(&d.configuration.b);
    if (!plane || plane->unit_displacement() == 0) continue;
    TestDatum& longer = made.emplace_back(d);
    longer.configuration.b = Plane(4 * plane->normal(), 4 * plane->displacement());
    csv += writer->add(longer);
  }
  ASSERT_GT(made.size(), 100u);
  expect_gaps_of_all_readers(made, csv + writer->finish());
}

// touchstone-suite-2.

std::string name_of(const SuiteFile& file) { return "2-" + std::string(file.name); }

std::vector<TestDatum> suite_2_data(const SuiteFile& file) {
  std::vector<TestDatum> result;
  make_suite_2(file, [&](const TestDatum& datum) { result.push_back(datum); });
  return result;
}

TEST(Suite2, IsWhatExportWritesToTheByteAndReadersKnowTheRegretOfAnyNormal) {
  std::size_t count = 0;
  for (const SuiteFile& file : suite_2_files()) {
    const auto made = suite_2_data(file);
    const auto writer = test_data_writer(TestDataFormat::csv, CsvColumns::suite_2);
    std::string text;
    for (const TestDatum& datum : made) text += writer->add(datum);
    text += writer->finish();
    EXPECT_TRUE(text == unpacked(name_of(file))) << file.name;
    expect_gaps_of_all_readers(made, text);
    count += made.size();
  }
  EXPECT_EQ(count, 600u);
}

TEST(Suite2, IsExactInSinglePrecisionAndHasAllPairsAndKindsOfAnswers) {
  std::map<std::string, int> contacts, ties, pairs;
  for (const SuiteFile& file : suite_2_files()) {
    for (const TestDatum& d : suite_2_data(file)) {
      Numbers numbers = numbers_of(d.configuration);
      for (const double* const x : every_number(numbers)) {
        EXPECT_EQ(static_cast<double>(static_cast<float>(*x)), *x) << to_string(d.identity);
      }
      ++contacts[contact_name(d.limits.contact)];
      ++ties[ties_name(d.truth.ties)];
      ++pairs[pair_name(d.identity.pose_class.pair)];
    }
  }
  EXPECT_EQ(contacts.size(), 3u);
  EXPECT_EQ(ties.size(), 3u);
  for (const auto& [pair, count] : pairs) EXPECT_EQ(count, 100) << pair;
}

// Answers: those of our own routines, and such as are wrong in a certain way.

struct PlantedFault {
  const char* name;
  /// Null where the fault need not show, as where several normals are right.
  const char* verdict;
  void (*plant)(ts_answer& answer, const TestDatum& datum);
};

void set(double (&to)[3], const Vec3& v) {
  for (int i = 0; i < 3; ++i) to[i] = v[i];
}

void shift(ts_answer& a, double distance) {
  a.signed_distance += distance;
  for (int i = 0; i < a.point_count; ++i) a.points[i].depth -= distance;
}

/// Turns the best normal, about the axis that costs more, until its regret is so many limits.
void turn_to_regret(ts_answer& a, const TestDatum& d, double limits) {
  const Vec3 best = d.truth.normals.front().n, e = best.unitOrthogonal();
  const auto turned = [&](const Vec3& axis, double angle) {
    return Vec3(Eigen::AngleAxisd(angle, axis) * best);
  };
  const auto regret = [&](const Vec3& axis, double angle) {
    return oracle::normal_regret(d.configuration, d.truth, turned(axis, angle));
  };
  const Vec3 other = best.cross(e);
  const Vec3& axis = regret(e, 1) > regret(other, 1) ? e : other;
  double low = 0, high = 1;
  while (high - low > 1e-15 * high) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (regret(axis, middle) < limits * d.limits.max_regret ? low : high) = middle;
  }
  set(a.normal, turned(axis, low));
}

/// On an answer that is a contact where one is required.
const PlantedFault faults[] = {
    {"none", "agree", [](ts_answer&, const TestDatum&) {}},
    {"two limits too shallow", "shallow",
     [](ts_answer& a, const TestDatum& d) { shift(a, 2 * d.limits.max_regret); }},
    {"two limits too deep", "overdeep",
     [](ts_answer& a, const TestDatum& d) { shift(a, -2 * d.limits.max_regret); }},
    {"normal turned to 0.95 limits of regret", "agree",
     [](ts_answer& a, const TestDatum& d) { turn_to_regret(a, d, 0.95); }},
    {"normal turned to 1.05 limits of regret", "wrong-normal",
     [](ts_answer& a, const TestDatum& d) { turn_to_regret(a, d, 1.05); }},
    {"normal turned by 20 degrees", nullptr,
     [](ts_answer& a, const TestDatum&) {
       const Vec3 n(a.normal);
       set(a.normal, Eigen::AngleAxisd(std::numbers::pi / 9, n.unitOrthogonal()) * n);
     }},
    {"normal reversed", nullptr,
     [](ts_answer& a, const TestDatum&) { set(a.normal, -Vec3(a.normal)); }},
    {"normal too long", "wrong-normal",
     [](ts_answer& a, const TestDatum&) { set(a.normal, 1.01 * Vec3(a.normal)); }},
    {"no normal", "wrong-normal",
     [](ts_answer& a, const TestDatum&) { set(a.normal, Vec3::Zero()); }},
    {"missed", "missed", [](ts_answer& a, const TestDatum&) { a.status = TS_NONE; }},
    {"no points", "shallow-points", [](ts_answer& a, const TestDatum&) { a.point_count = 0; }},
    {"points two limits too shallow", "shallow-points",
     [](ts_answer& a, const TestDatum& d) {
       for (int i = 0; i < a.point_count; ++i) {
         a.points[i].depth =
             std::min(a.points[i].depth, -d.limits.max_distance) - d.limits.max_regret;
       }
     }},
    {"a point two limits too deep", "overdeep-points",
     [](ts_answer& a, const TestDatum& d) {
       a.points[0].depth = -d.limits.min_distance + d.limits.max_regret;
     }},
    {"a point beyond the threshold", "phantom-points",
     [](ts_answer& a, const TestDatum& d) {
       ts_point& p = a.points[a.point_count++];
       p = a.points[0];
       p.depth = 2 * d.limits.min_point_depth;
     }},
    {"not finite", "not-finite",
     [](ts_answer& a, const TestDatum&) { a.points[0].position[1] = std::nan(""); }},
    {"infinite", "not-finite",
     [](ts_answer& a, const TestDatum&) { a.signed_distance = -INFINITY; }},
    {"failed", "failed", [](ts_answer& a, const TestDatum&) { a.status = TS_FAILED; }},
    {"unsupported", "unsupported",
     [](ts_answer& a, const TestDatum&) { a.status = TS_UNSUPPORTED; }},
};

/// The suite's verdict has a rule of its own, which never changes: normals are judged against the
/// whole bodies, however large, and points by their depths alone.
std::string verdict_of(const TestDatum& d, const ts_answer& a) {
  const Bar bar = suite_1().bar;
  const Score s = score(d.configuration, d.truth, a, bar);
  const bool is_by_points = s.outcome == Outcome::agree || is_of_points(s.outcome);
  if (is_by_points && s.whole_regret.value_or(0) > bar.tolerance) return "wrong-normal";
  if (s.outcome == Outcome::no_points) {
    return d.limits.contact == AnswerLimits::Contact::required ? "shallow-points" : "agree";
  }
  const bool is_right = agrees(s.outcome) || s.outcome == Outcome::off_body;
  return outcome_name(is_right ? Outcome::agree : s.outcome);
}

ts_answer contact_made_up(const TestDatum& d) {
  ts_answer a{};
  a.status = TS_CONTACT;
  a.signed_distance = -d.limits.max_regret / 2;
  set(a.normal, d.truth.normals.front().n);
  return a;
}

json vector_json(const double (&v)[3]) {
  return {number_json(v[0]), number_json(v[1]), number_json(v[2])};
}

json line_of(const std::string& id, const ts_answer& a) {
  json line = {{"id", id}, {"status", status_name(a.status)}};
  if (a.status != TS_CONTACT) return line;
  line["signed_distance"] = number_json(a.signed_distance);
  line["normal"] = vector_json(a.normal);
  line["points"] = json::array();
  for (int i = 0; i < a.point_count; ++i) {
    line["points"].push_back({{"position", vector_json(a.points[i].position)},
                              {"depth", number_json(a.points[i].depth)}});
  }
  return line;
}

touchstone_suite::Answer for_the_reader(const ts_answer& a) {
  touchstone_suite::Answer result{
      status_name(a.status), a.signed_distance, {a.normal[0], a.normal[1], a.normal[2]}, {}};
  for (int i = 0; i < a.point_count; ++i) {
    const ts_point& p = a.points[i];
    result.points.push_back({p.position[0], p.position[1], p.position[2], p.depth});
  }
  return result;
}

/// An answer to each configuration of the suite, with the faults in turns; where there need not be
/// a contact, our own answer and one that is made up.
struct Answers {
  std::vector<ts_answer> all;
  std::vector<const PlantedFault*> planted;  ///< null: none that is in the list
  std::vector<std::string> verdicts;         ///< by the suite's rule
  std::vector<std::string> outcomes;         ///< by score()
  std::string lines;                         ///< of a file of them
};

const Answers& answers() {
  static const Answers result = [] {
    std::vector<Configuration> configurations;
    for (const TestDatum& d : data()) configurations.push_back(d.configuration);
    const auto own = CandidateProcess(find_candidate("reference"), suite_1().bar.threshold)
                         .answers(configurations);
    Answers made;
    made.lines = R"({"candidate": "planted", "version": "1", "settings": "by suite_test.cpp"})"
                 "\n";
    for (std::size_t i = 0, turn = 0; i < data().size(); ++i) {
      const TestDatum& d = data()[i];
      ts_answer a = own[i];
      const PlantedFault* fault = nullptr;
      if (d.limits.contact == AnswerLimits::Contact::required && a.status == TS_CONTACT) {
        fault = &faults[turn++ % std::size(faults)];
        fault->plant(a, d);
      } else if (i % 2 == 0) {
        a = contact_made_up(d);
      }
      made.verdicts.push_back(verdict_of(d, a));
      made.outcomes.emplace_back(
          outcome_name(score(d.configuration, d.truth, a, suite_1().bar).outcome));
      made.lines += line_of(to_string(d.identity), a).dump() + '\n';
      made.all.push_back(a);
      made.planted.push_back(fault);
    }
    return made;
  }();
  return result;
}

TEST(Verdicts, OfTheScoreNameThePlantedFault) {
  std::map<std::string, int> seen;
  for (std::size_t i = 0; i < data().size(); ++i) {
    const PlantedFault* const fault = answers().planted[i];
    ++seen[answers().verdicts[i]];
    if (fault && fault->verdict) {
      EXPECT_EQ(answers().verdicts[i], fault->verdict)
          << to_string(data()[i].identity) << ' ' << fault->name;
    } else if (!fault && data()[i].limits.contact == AnswerLimits::Contact::forbidden) {
      EXPECT_EQ(answers().verdicts[i], answers().all[i].status == TS_NONE ? "agree" : "phantom");
    }
  }
  for (const char* verdict :
       {"agree", "missed", "phantom", "shallow", "overdeep", "wrong-normal", "not-finite", "failed",
        "unsupported", "shallow-points", "overdeep-points", "phantom-points"}) {
    EXPECT_GT(seen[verdict], 30) << verdict;
  }
}

TEST(Verdicts, OfTheThreeReadersAreThoseOfTheScore) {
  for (std::size_t i = 0; i < data().size(); ++i) {
    const auto& c = cases_read()[i];
    EXPECT_EQ(verdict(c, for_the_reader(answers().all[i])), answers().verdicts[i]) << c.id;
  }
  for (const auto& verdicts : verdicts_of_judges(suite_file("1"), answers().lines)) {
    EXPECT_EQ(verdicts, answers().verdicts);
  }
}

TEST(Verdicts, OfTouchstoneScoreAreThoseOfTheScore) {
  std::istringstream in(answers().lines);
  const ReadAnswers read = read_answers(in, {}, {nullptr, identities(suite_1())});
  EXPECT_TRUE(read.errors.empty());
  const Report report = report_of(read.answers, read.seed, Bar(), 2, "x");
  using Counts = std::map<std::string, std::uint64_t>;
  std::map<std::string, Counts> expected, reported;
  for (std::size_t i = 0; i < data().size(); ++i) {
    const Identity& id = data()[i].identity;
    ++expected[std::string(pair_name(id.pose_class.pair)) + id.pose_class.name()]
              [answers().outcomes[i]];
  }
  for (const ResultRow& row : report.results) {
    EXPECT_EQ(row.candidate, "planted");
    for (const Outcome o : all_outcomes) {
      if (const auto count = row.statistics.of(o)) {
        reported[row.pair + row.pose_class][outcome_name(o)] = count;
      }
    }
  }
  EXPECT_EQ(reported, expected);
}

/// An answer that is wrong in double precision by what single precision is allowed.
TEST(Readers, AllowRoutinesInFloatWhatFloatsCost) {
  const SuiteFile& file = suite_2_files().front();
  std::ostringstream lines;
  std::vector<touchstone_suite::Answer> given;
  std::vector<touchstone_suite::Case> required;
  std::istringstream in(unpacked(name_of(file)));
  for (const auto& c : touchstone_suite::read(in)) {
    if (c.contact != "required" || touchstone_suite::in_float(c).contact != "required") continue;
    const double distance = c.signed_distance - (c.max_regret + c.float_tolerance) / 2;
    given.push_back({"contact", distance, c.normal, {{0, 0, 0, -distance}}});
    required.push_back(c);
    lines << json{{"id", c.id},
                  {"status", "contact"},
                  {"signed_distance", distance},
                  {"normal", {c.normal[0], c.normal[1], c.normal[2]}},
                  {"points", {{{"position", {0, 0, 0}}, {"depth", -distance}}}}}
          << '\n';
  }
  ASSERT_GT(given.size(), 10u);
  for (const bool single : {false, true}) {
    const std::string right = single ? "agree" : "overdeep";
    for (std::size_t i = 0; i < given.size(); ++i) {
      const auto& c = required[i];
      EXPECT_EQ(verdict(single ? in_float(c) : c, given[i]), right) << c.id;
    }
    const std::string suite = (single ? "--float " : "") + suite_file(name_of(file));
    const std::vector<std::string> expected(given.size(), right);
    EXPECT_THAT(verdicts_of_judges(suite, lines.str()), testing::Each(expected));
  }
}

// Files that are none: a reader says in one line where and what is wrong.

/// What both judges say of a suite and answers, which has to be one line, with exit code 2.
void expect_refusal(const std::string& suite, const std::string& answers,
                    const std::string& expected) {
  for (const std::string& judge : judges) {
    SCOPED_TRACE(judge + suite + ' ' + answers);
    const std::string said =
        printed_by("{ " + judge + suite + ' ' + answers + " 2>&1; echo \"exit $?\"; }");
    EXPECT_THAT(said, testing::HasSubstr(expected));
    EXPECT_THAT(said, testing::EndsWith("\nexit 2\n"));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2) << said;
  }
}

std::string refusal_in_cpp(const std::string& csv) {
  std::istringstream in(csv);
  try {
    return std::to_string(touchstone_suite::read(in, "given").size()) + " cases";
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

TEST(Readers, RefuseASuiteThatIsCutOffDamagedOrNone) {
  const OwnFolder folder;
  const std::string answer =
      folder.with("answers", R"({"id": "cylinder-box/recorded/1/13", "status": "none"})");
  std::string damaged = committed();
  damaged.replace(damaged.find("0.5297436105760894"), 18, "0,5297436105760894");
  std::string no_number = committed();
  no_number.replace(no_number.find("0.5297436105760894"), 3, "O.5");
  const std::string row =
      committed().substr(0, committed().rfind('\n', committed().size() - 2) + 1);
  const auto expect_refused = [&](const std::string& csv, const std::string& judges_say,
                                  const std::string& cpp_says) {
    expect_refusal(folder.with("suite.csv", csv), answer, judges_say);
    EXPECT_THAT(refusal_in_cpp(csv), testing::StartsWith("given:" + cpp_says));
  };
  expect_refused("", "suite.csv:1: must be the columns", "1: nothing can be read");
  expect_refused("a,b\n1,2\n", "suite.csv:1: must be the columns", "1: must be the columns");
  expect_refused(committed().substr(0, 100000), "suite.csv:147: has 18 cells: must have 35",
                 "147: position_b_z is missing");
  expect_refused(row, "suite.csv: has 5105 configurations: must have 5106",
                 " has 5105 configurations: must have 5106");
  expect_refused(no_number, "suite.csv:2: radius_a is \"O.5297436105760894\": must be a number",
                 "2: radius_a is \"O.5297436105760894\": must be a number");
  expect_refused(damaged, "suite.csv:2: has 36 cells: must have 35",
                 "2: size_b_1 is \"plane\": must be a number");
  const std::string second = unpacked("2-smoke");
  const std::string shorter = second.substr(0, second.rfind("cylinder-convex"));
  expect_refused(shorter, "suite.csv:61: must be \"# 59 configurations\"",
                 "61: must be \"# 59 configurations\"");
  expect_refusal("--float " + suite_file("1"), answer, "has no float_tolerance");
  expect_refusal((folder.path / "none.csv").string(), answer, "none.csv: cannot be read: ");
  const std::string bytes = read_file(suite_file("1"), "file");
  EXPECT_THAT(refusal_in_cpp(bytes), testing::EndsWith("unpack a .gz by gzip -d"));
  expect_refusal(folder.with("packed.csv", bytes), answer, "packed.csv:");
  expect_refusal(folder.with("cut.csv.gz", bytes.substr(0, 50000)), answer,
                 "cut.csv.gz: cannot be read: ");
  std::ifstream missing((folder.path / "none.csv").string());
  EXPECT_THROW(touchstone_suite::read(missing), std::runtime_error);
}

TEST(Readers, RefuseAnswersThatAreNoneAndNameTheLineAndTheField) {
  const OwnFolder folder;
  const std::string small = suite_file("2-smoke");  // read for each refusal
  const auto expect_refused = [&](const std::string& text, const std::string& expected) {
    expect_refusal(small, folder.with("answers", text), "answers" + expected);
  };
  const std::string id = R"({"id": "cylinder-plane/general+apart/2/0")";
  const std::string good = id + R"(, "status": "none"})" + '\n';
  const std::string contact = good + id + R"(, "status": "contact")";
  expect_refused("", ": has no answers");
  expect_refused(R"({"candidate": "mine"})", ": has no answers");
  expect_refused("[1]", ":1: is no object");
  expect_refused(good + "hello", ":2: is not JSON (");
  const std::string byte_order_mark = "\xef\xbb\xbf";  // which may stand before the first line
  expect_refused(byte_order_mark + good + "hello", ":2: is not JSON (");
  expect_refused(good + byte_order_mark + good, ":2: is not JSON (");
  expect_refused(good + R"({"status": "none"})", ":2: id is missing");
  expect_refused(R"({"id": "mine/1", "status": "none"})",
                 ":1: id is \"mine/1\": must be that of a configuration");
  expect_refused(R"({"id": true, "status": "none"})",
                 ":1: id is true: must be that of a configuration");
  expect_refused(R"({"id": [], "status": "none"})",
                 ":1: id is []: must be that of a configuration");
  expect_refused(id + "}", ":1: status is missing");
  expect_refused(contact + "}", ":2: signed_distance is missing: must be a number");
  expect_refused(contact + R"(, "signed_distance": -1, "points": []})",
                 ":2: normal is missing: must be [x, y, z]");
  expect_refused(contact + R"(, "signed_distance": "-1", "normal": [0, 0, 1], "points": []})",
                 ":2: signed_distance is not usable: must be a number");
  expect_refused(contact + R"(, "signed_distance": -1, "normal": [0, 1], "points": []})",
                 ":2: normal is not usable");
  expect_refused(contact + R"(, "signed_distance": -1, "normal": [0, 0, 1]})",
                 ":2: points is missing");
  expect_refused(
      contact + R"(, "signed_distance": -1, "normal": [0, 0, 1], "points": [{"depth": 1}]})",
      ":2: points is not usable");
}

TEST(Readers, SayWhatWouldBeRight) {
  const auto& c = cases_read().front();
  const std::string text = touchstone_suite::right(c);
  EXPECT_THAT(text, testing::HasSubstr("contact " + c.contact + ", signed distance "));
  EXPECT_THAT(text, testing::HasSubstr(", normal "));
}

}  // namespace
}  // namespace touchstone
