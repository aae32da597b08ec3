#include "reports/terminal.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <sstream>

#include "reports/small_report_test.hpp"
#include "simulation/engines/run_engines.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Lines that are wider than the terminal, but for commands.
std::vector<std::string> wide_lines(const std::string& text, std::size_t columns) {
  std::vector<std::string> wide;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
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
    std::istringstream table(terminal_table(report, {columns, false}));
    for (std::string line; std::getline(table, line);) {
      if (line.find("./touchstone") == std::string::npos) {  // a command is not broken
        EXPECT_LE(line.size(), columns) << line;
      }
    }
  }
}

TEST(ReportTable, KeepsInANarrowTerminalWhatMattersMost) {
  const Report& report = report_of_some();
  const auto headings = [&](std::size_t columns) {
    const std::string table = terminal_table(report, {columns, false});
    std::istringstream line(table.substr(0, table.find('\n')));
    return std::vector<std::string>(std::istream_iterator<std::string>(line), {});
  };
  EXPECT_THAT(headings(80), testing::ElementsAre("candidate", "agree%", "yes/no", "err", "bias",
                                                 "pts", "cover", "ns", "p95", "times"));
  EXPECT_THAT(headings(40), testing::ElementsAre("candidate", "agree%", "yes/no", "err", "ns"));
}

TEST(ReportTable, ShowsTheBinOfZeroAsZero) {
  Report report = report_of_some();
  constexpr double denormal = 2.8e-309;
  for (ResultRow& row : report.summary) {
    row.statistics.point_error = Quantiles{0, denormal, 1};
    row.statistics.bias = SignedMedian{-denormal};
  }
  EXPECT_THAT(terminal_table(report), testing::Not(HasSubstr("e-3")));
}

TEST(ReportTable, ColoursChangeNothingElse) {
  const Report& report = report_of_some();
  const std::string coloured = terminal_table(report, {80, true});
  EXPECT_NE(coloured, terminal_table(report));
  EXPECT_EQ(std::regex_replace(coloured, std::regex("\x1b\\[[0-9]*m"), ""), terminal_table(report));
}

TEST(ReportTable, NamesThePoseClassesWithASlowTail) {
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
  EXPECT_THAT(terminal_table(report), Not(HasSubstr("Slow tails")));
  add("touching", 100, 401);
  add("vertex-rim", 300, 1300);
  EXPECT_THAT(terminal_table(report),
              HasSubstr("mine in 2 of 3 pose classes; cylinder-box/vertex-rim: median 300 ns, p95\n"
                        "    1300 ns\n"));
}

}  // namespace
}  // namespace touchstone
