#include "reports/terminal.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <sstream>

#include "reference/invalid_input.hpp"
#include "reports/engine_table.hpp"
#include "reports/small_report_test.hpp"
#include "simulation/engines/run_engines.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Lines that are wider than the terminal, but for commands.
std::vector<std::string> wide_lines(const std::string& text, std::size_t columns) {
  std::vector<std::string> wide;
  for (const std::string& line : lines_of(text)) {
    const bool is_command = line.find("./touchstone") != std::string::npos;
    const auto letters =
        std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
    if (!is_command && static_cast<std::size_t>(letters) > columns) wide.push_back(line);
  }
  return wide;
}

TEST(FoldedText, KeepsLinesThatFit) {
  EXPECT_EQ(Terminal{40}.folded("a  b\n\n  c"), "a  b\n\n  c\n");
}

TEST(FoldedText, GoesOnFurtherInBelowAnIndentedLine) {
  const std::string words = "one two three four five six seven eight";
  EXPECT_EQ(Terminal{20}.folded("  " + words),
            "  one two three\n    four five six\n    seven eight\n");
  EXPECT_EQ(Terminal{20}.folded(words), "one two three four\nfive six seven eight\n");
}

TEST(FoldedText, CountsLettersNotBytes) {
  const std::string micro = "\u00b5\u00b5\u00b5\u00b5 \u00b5\u00b5\u00b5\u00b5";
  EXPECT_EQ(Terminal{9}.folded(micro), micro + '\n');
}

TEST(FoldedText, LeavesCommandsWhole) {
  const std::string command =
      "    ./touchstone replay cylinder-box/rim-face/1/2 --candidates bullet";
  EXPECT_EQ(Terminal{40}.folded(command), command + '\n');
}

TEST(TextTable, LeavesOutColumnsOfTheHighestRankFirst) {
  const TextTable table("name", 6, {{"first", 15, 0}, {"third", 15, 2}, {"second", 15, 1}}, {40});
  EXPECT_EQ(table.headings(), "name             first          second\n");
  EXPECT_EQ(table.row("a", {{"1"}, {"3"}, {"2"}}), "a                    1               2\n");
  EXPECT_FALSE(table.has("third"));
  EXPECT_THAT(table.what_is_left_out(), HasSubstr("Wider terminals"));
}

TEST(TextTable, ALongNameHasALineOfItsOwn) {
  const TextTable table("name", 4, {{"first", 5}}, {});
  EXPECT_EQ(table.row("much-longer", {{"1"}}), "much-longer\n         1\n");
}

ExperimentResult result_of(const std::string& candidate) {
  ExperimentResult r;
  r.experiment = "standing";
  r.candidate = candidate;
  r.step = 1.0 / 240;
  r.value = -1.23e-10;
  r.error = 1e-9;
  r.energy_gained = 1e-10;
  r.nanoseconds = 12345;
  return r;
}

const ExperimentDescription standing{
    "standing", "",  "kinetic energy that stays, in weight x radius", "radii from its place", {0},
    {0.009},    true};

TEST(ExperimentsTable, FitsIntoTheTerminalsColumns) {
  ExperimentResults results{{1.0 / 240}, {standing}, {result_of("capsule-circumscribed")}};
  results.results.push_back(result_of("reference"));
  results.results.back().exact = true;
  for (const std::size_t columns : {40, 60, 80}) {
    EXPECT_THAT(wide_lines(experiments_table(results, {columns}), columns), testing::IsEmpty());
  }
  EXPECT_THAT(experiments_table(results), HasSubstr("us/step: time of a whole step"));
  EXPECT_THAT(experiments_table(results, {40}), Not(HasSubstr("us/step")));
}

EngineResults of_engines(const ExperimentResult& own, const ExperimentResult& cured) {
  return {1.0 / 240,
          {{"bullet", "3.24", "double precision; sequential impulses, 10 iterations, warm starting",
            "200 iterations, friction along two directions"}},
          {standing},
          {{"standing", "bullet", Cure::held, own, cured, cured}}};
}

TEST(EnginesTable, FitsIntoTheTerminalsColumns) {
  ExperimentResult lost = result_of("bullet");
  lost.outcome = ExperimentResult::Outcome::crashed;
  lost.reason = "the engine ended its process by signal 11, as a wrong pointer does";
  for (const auto& own : {result_of("bullet"), lost}) {
    const EngineResults results = of_engines(own, result_of("bullet"));
    for (const std::size_t columns : {40, 60, 80}) {
      const Terminal terminal{columns};
      EXPECT_THAT(wide_lines(engines_table(results, terminal), columns), testing::IsEmpty());
      EXPECT_THAT(wide_lines(engines_summary(results, terminal), columns), testing::IsEmpty());
    }
  }
}

TEST(EnginesTable, CountsOnlyTheCuresThatThereAre) {
  const ExperimentResult result = result_of("bullet");
  EXPECT_THAT(engines_table(of_engines(result, result)), HasSubstr("; 1 in all: 1 held.\n"));
}

TEST(EnginesTable, SaysOfWhatIsHeldAndStillMovesThatItJitters) {
  ExperimentResult held = result_of("bullet"), restless = result_of("bullet");
  held.exact = true;
  held.last_time = restless.last_time = 10;
  held.last_motion = restless.last_motion = 9.9;
  const std::string jitters = engines_table(of_engines(held, held));
  EXPECT_THAT(jitters, HasSubstr(" jitter "));
  EXPECT_THAT(jitters, Not(HasSubstr("never")));
  EXPECT_THAT(engines_table(of_engines(restless, held)), HasSubstr(" never "));
}

TEST(ReportTable, FitsIntoTheTerminalsColumns) {
  Report report = report_of_some();
  report.partial = true;
  report.results[0].time->p95 = 1e5;
  for (const std::size_t columns : {40, 57, 80}) {
    EXPECT_THAT(wide_lines(terminal_table(report, {columns}), columns), testing::IsEmpty());
    EXPECT_THAT(wide_lines(terminal_details(report, {columns}), columns), testing::IsEmpty());
  }
}

/// A row over all pairs, of 100 configurations of which so many agree; the others are missed.
ResultRow row_over_all(const char* group, const std::string& candidate, std::uint64_t agreeing) {
  ResultRow row;
  row.pair = "cylinder-box";
  row.pose_class = group;
  row.candidate = candidate;
  row.statistics.count = 100;
  row.statistics.outcomes[static_cast<std::size_t>(Outcome::agree)] = agreeing;
  row.statistics.outcomes[static_cast<std::size_t>(Outcome::missed)] = 100 - agreeing;
  row.time = QueryTime{.nanoseconds = {100, 100, 100}, .repetitions = 5};
  return row;
}

/// Candidates with the share of everyday poses on which they agree; a little less in others.
Report report_of(const std::vector<std::pair<std::string, std::uint64_t>>& agreeing) {
  Report report;
  report.tolerance = 1e-4;
  for (const auto& [name, count] : agreeing) {
    report.candidates.push_back({name, name, "1", "", ""});
  }
  for (const char* group : {"everyday", "degenerate", "extreme", "recorded"}) {
    for (const auto& [name, count] : agreeing) {
      report.summary.push_back(row_over_all(group, name, count));
    }
  }
  return report;
}

TEST(ReportTable, HasTheBestFirstAndOurOwnRoutineBelowTheOthers) {
  const auto lines = lines_of(
      terminal_table(report_of({{"reference", 100}, {"poor", 31}, {"good", 99}, {"fair", 58}})));
  ASSERT_GT(lines.size(), 7u);
  EXPECT_THAT(lines[0], testing::StartsWith("candidate everyday degen. extreme"));
  EXPECT_THAT(lines[1], testing::StartsWith("good          99.0   99.0    99.0"));
  EXPECT_THAT(lines[2], testing::StartsWith("fair          58.0"));
  EXPECT_THAT(lines[3], testing::StartsWith("poor          31.0"));
  EXPECT_EQ(lines[4], "");
  EXPECT_EQ(lines[5], "reference (Touchstone's own)");
  EXPECT_THAT(lines[6], testing::StartsWith("             100.0  100.0   100.0"));
}

TEST(ReportTable, IsOneScreenOfFortyLines) {
  Report report = report_of({{"reference", 100},
                             {"bullet", 86},
                             {"bullet-margin-0", 99},
                             {"bullet-float", 78},
                             {"ode", 90},
                             {"fcl", 97},
                             {"libccd-mpr", 83},
                             {"mujoco", 80},
                             {"capsule", 70},
                             {"capsule-circumscribed", 45},
                             {"spheres:8", 66},
                             {"prism:16", 65}});
  report.partial = true;
  for (const char* name : {"bullet", "bullet-float", "ode", "mujoco"}) {
    WorstCase worst = report_of_some().worst.front();
    worst.candidate = name;
    worst.pair = "cylinder-box";
    worst.group = "everyday";
    worst.score.outcome = Outcome::missed;
    worst.examination.replay = std::string("./touchstone replay ") + name;
    report.worst.push_back(worst);
  }
  const std::string text = terminal_table(report);
  EXPECT_LE(lines_of(text).size(), 37u) << text;  // three are below it
  EXPECT_THAT(wide_lines(text, 80), testing::IsEmpty());
  for (const char* heading :
       {"everyday", "degen.", "extreme", "missed", "made up", "err p99", "ns", "times"}) {
    EXPECT_THAT(lines_of(text)[2], HasSubstr(heading));
  }
  EXPECT_THAT(lines_of(text)[2], Not(HasSubstr("recorded")));
}

TEST(ReportTable, SaysOfACandidateWithoutARoutineNothing) {
  Report report = report_of({{"plain", 50}, {"other", 50}});
  for (ResultRow& row : report.summary) {
    if (row.candidate != "other") continue;
    row.statistics.outcomes = {};
    row.statistics.outcomes[static_cast<std::size_t>(Outcome::unsupported)] = 100;
  }
  EXPECT_THAT(lines_of(terminal_table(report))[2], testing::MatchesRegex("other( +-){9}"));
}

TEST(ReportTable, SaysWhyNothingWasScored) {
  Report report = report_of({{"mine", 50}});
  for (ResultRow& row : report.summary) {
    row.statistics.outcomes = {};
    row.statistics.outcomes[static_cast<std::size_t>(Outcome::unsupported)] = row.statistics.count;
  }
  for (const auto text : {terminal_table, terminal_details}) {
    EXPECT_THAT(text(report, {}),
                testing::StartsWith("Nothing was scored: mine answers \"unsupported\" to every "));
  }
  report.candidates.push_back({"yours", "", "", "", ""});
  EXPECT_THAT(terminal_table(report), HasSubstr(": mine, yours answer \"unsupported\""));
}

TEST(ReportTable, SaysOfACandidateThatNeverAnswersThatItIsNeverRight) {
  Report report = report_of({{"silent", 0}});
  for (ResultRow& row : report.summary) {
    row.statistics.outcomes = {};
    row.statistics.outcomes[static_cast<std::size_t>(Outcome::crashed)] = 100;
    row.time.reset();
  }
  EXPECT_THAT(lines_of(terminal_table(report))[1],
              testing::MatchesRegex("silent    +0.0 +0.0 +0.0 +0.0 +0 +0 +-"));
}

TEST(ReportTable, SaysNothingOfGroupsThatWereNotScored) {
  Report report = report_of({{"mine", 50}});
  std::erase_if(report.summary, [](const ResultRow& row) { return row.pose_class != "recorded"; });
  const std::string text = terminal_table(report);
  EXPECT_THAT(text, testing::StartsWith("candidate recorded missed"));
  EXPECT_THAT(text, HasSubstr("Of recorded poses alone"));
  report.summary.clear();
  EXPECT_EQ(terminal_table(report), "");
}

TEST(ReportTable, KeepsInANarrowTerminalTheSharesOfEverydayPoses) {
  const std::string text = terminal_table(report_of({{"capsule-circumscribed", 50}}), {40});
  EXPECT_EQ(lines_of(text)[0], "candidate             everyday    ns");
  EXPECT_THAT(text, HasSubstr("Wider terminals"));
}

TEST(ReportDetails, KeepsInANarrowTerminalWhatMattersMost) {
  const Report& report = report_of_some();
  const auto headings = [&](std::size_t columns) {
    const std::string table = terminal_details(report, {columns, false});
    std::istringstream line(table.substr(0, table.find('\n')));
    return std::vector<std::string>(std::istream_iterator<std::string>(line), {});
  };
  EXPECT_THAT(headings(80), testing::ElementsAre("candidate", "agree%", "yes/no", "err", "bias",
                                                 "pts", "cover", "ns", "p95", "times"));
  EXPECT_THAT(headings(40), testing::ElementsAre("candidate", "agree%", "yes/no", "err", "ns"));
}

TEST(ReportDetails, ShowsTheBinOfZeroAsZero) {
  Report report = report_of_some();
  constexpr double denormal = 2.8e-309;
  for (ResultRow& row : report.summary) {
    row.statistics.point_error = Quantiles{0, denormal, 1};
    row.statistics.bias = SignedMedian{-denormal};
  }
  EXPECT_THAT(terminal_details(report), testing::Not(HasSubstr("e-3")));
}

TEST(ReportDetails, ColoursChangeNothingElse) {
  const Report& report = report_of_some();
  const std::string coloured = terminal_details(report, {80, true});
  EXPECT_NE(coloured, terminal_details(report));
  EXPECT_EQ(std::regex_replace(coloured, std::regex("\x1b\\[[0-9]*m"), ""),
            terminal_details(report));
}

TEST(ReportDetails, NamesThePoseClassesWithASlowTail) {
  Report report;
  report.candidates = {{"mine", "mine", "1", "", ""}};
  const auto add = [&](const char* pose_class, double median, std::optional<double> p95) {
    ResultRow row;
    row.pair = "cylinder-box";
    row.pose_class = pose_class;
    row.candidate = "mine";
    row.statistics.count = 1;
    row.time = QueryTime{.nanoseconds = {median, median, median}, .repetitions = 5, .p95 = p95};
    report.results.push_back(row);
  };
  add("general", 100, 400);
  add("parallel", 100, std::nullopt);
  EXPECT_THAT(terminal_details(report), Not(HasSubstr("Slow tails")));
  add("touching", 100, 401);
  add("vertex-rim", 300, 1300);
  EXPECT_THAT(terminal_details(report),
              HasSubstr("mine in 2 of 3 pose classes; cylinder-box/vertex-rim: median 300 ns, p95\n"
                        "    1300 ns\n"));
}

// The table of candidates by pairs for a page of somebody's own.

Statistics right_but(std::uint64_t missed, std::map<int, std::uint64_t> points = {}) {
  Statistics s;
  s.count = 10;
  s.outcomes[static_cast<std::size_t>(Outcome::agree)] = 10 - missed;
  s.outcomes[static_cast<std::size_t>(Outcome::missed)] = missed;
  s.points = std::move(points);
  s.depth_error = Quantiles{1e-9, 1e-6, 2e-3};
  return s;
}

/// Of two candidates: one that knows boxes alone, and one that is always right there.
Report two_on_boxes() {
  Report r;
  r.version = "1";
  r.command = "touchstone report --name a<b";
  for (const char* name : {"one", "two"}) {
    CandidateDescription& c = r.candidates.emplace_back();
    c.name = name;
    c.version = "2.0";
  }
  const auto row = [](const char* pair, const char* of, const char* candidate, Statistics s) {
    return ResultRow{pair, of, candidate, std::move(s), {}, {}, {}, {}};
  };
  r.summary.push_back(row("cylinder-box", "everyday", "one", right_but(3)));
  r.summary.push_back(row("cylinder-box", "everyday", "two", right_but(0)));
  r.summary.push_back(row("cylinder-plane", "everyday", "two", right_but(0)));
  r.results.push_back(row("cylinder-box", "rim-face", "one", right_but(1)));
  r.results.push_back(row("cylinder-box", "vertex-cap", "one", right_but(3)));
  r.results.push_back(
      row("cylinder-box", "cap-on-face-centred+turned", "one", right_but(0, {{1, 2}, {4, 7}})));
  // The everyday poses are those that count, though more fail here.
  r.results.push_back(row("cylinder-box", "general-deep", "one", right_but(9)));
  r.results.push_back(row("cylinder-box", "general-deep", "two", right_but(9)));
  return r;
}

TEST(EngineTable, HasTheShareOfRightAnswersPointsAtRestAndTheLargestErrorOfEachPair) {
  EXPECT_EQ(engine_table(two_on_boxes(), false),
            "Of everyday poses: % answered right, points of a contact at rest, largest depth error "
            "in the smaller size, median ns. By Touchstone 1: `touchstone report --name a<b`\n\n"
            "|engine|cylinder-plane|cylinder-box|fails first|\n"
            "|---|---|---|---|\n"
            "|one<br>2.0|-|70.0<br>4<br>2e-03<br>-|cylinder-box/vertex-cap:<br>missed|\n"
            "|two<br>2.0|100.0<br>-<br>2e-03<br>-|100.0<br>-<br>2e-03<br>-|"
            "cylinder-box/general-deep:<br>missed|\n");
}

TEST(EngineTable, IsAPageWhereItsFilesNameSaysSo) {
  const std::string page = engine_table(two_on_boxes(), true);
  EXPECT_THAT(page, testing::StartsWith("<!doctype html>"));
  EXPECT_THAT(page, testing::HasSubstr("<code>touchstone report --name a&lt;b</code>"));
  EXPECT_THAT(page, testing::HasSubstr("<tr><th>engine</th><th>cylinder-plane</th><th>"));
  EXPECT_THAT(page, testing::HasSubstr("<tr><td>one<br>2.0</td><td>-</td><td>70.0<br>4<br>"));
  EXPECT_TRUE(is_html_table("a/b.html"));
  EXPECT_FALSE(is_html_table("a/b.md"));
  EXPECT_THROW(is_html_table("a/b"), InvalidInput);
}

}  // namespace
}  // namespace touchstone
