#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "candidates/host/interruption.hpp"
#include "oracle/as_hull.hpp"
#include "oracle/truth.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/own_folder_test.hpp"
#include "reference/invalid_input.hpp"
#include "reports/make_report.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/row_text.hpp"
#include "reports/small_report_test.hpp"
#include "reports/solve.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

TEST(Report, DoesNotDependOnTheNumberOfWorkers) {
  EXPECT_EQ(without_times(report_of(some_configurations(1))),
            without_times(report_of(some_configurations(3))));
}

TEST(Report, HasARowForEveryPairClassAndCandidate) {
  const json report = to_json(report_of_some());
  // Plane has no concentric poses.
  EXPECT_EQ(report["classes"].size(), 5u);
  EXPECT_EQ(report["results"].size(), 20u);
  // Pairs and groups: both pairs and all in everyday and in degenerate poses.
  EXPECT_EQ(report["summary"].size(), 24u);
  EXPECT_EQ(report["configurations"], 20);
  for (const json& row : report["results"]) {
    EXPECT_EQ(row["count"], 4);
    EXPECT_GT(row["nanoseconds"]["median"], 0);
    std::size_t outcomes = 0;
    for (const json& n : row["outcomes"]) outcomes += n.get<std::size_t>();
    EXPECT_EQ(outcomes, 4u);
  }
}

TEST(Report, SaysHowOftenArrangementsOccurInScenesForItsOwnPairs) {
  const json report = to_json(report_of_some());
  std::map<std::string, double> sums;
  for (const json& row : report["recorded"]) {
    sums[row["pair"]] += row["share"].get<double>();
    EXPECT_TRUE(row["tilt"].is_null() || row["tilt"] <= 15);
    EXPECT_TRUE(row["arrangement"].is_string());
  }
  EXPECT_EQ(sums.size(), 2u);
  for (const char* pair : {"cylinder-plane", "cylinder-box"}) EXPECT_NEAR(sums[pair], 1, 1e-12);
}

TEST(Report, HasNoRowOverAllGroups) {
  const json report = to_json(report_of_some());
  std::map<std::string, std::uint64_t> in_summary, in_classes;
  for (const json& row : report["summary"]) {
    EXPECT_NO_THROW(parse_group(row["class"].get<std::string>()));
    if (row["pair"] != "all") in_summary[row["class"]] += row["count"].get<std::uint64_t>();
  }
  for (const json& c : report["classes"]) {
    in_classes[c["group"]] += 4 * report["candidates"].size();
    EXPECT_FALSE(c["arrangement"].get<std::string>().empty());
    EXPECT_TRUE(c["modifiers"].is_array());
  }
  EXPECT_EQ(in_summary, in_classes);
  for (const char* list : {"trends", "worst"}) {
    ASSERT_FALSE(report[list].empty());
    for (const json& entry : report[list]) EXPECT_TRUE(in_classes.contains(entry["group"])) << list;
  }
}

TEST(Report, ARowsWorstIndexLeadsToItsWorstFailure) {
  const json report = to_json(report_of_some());
  auto candidates = start(some_configurations().candidates, 0);
  int failing = 0;
  for (const json& row : report["results"]) {
    const bool fails = row["outcomes"].value("agree", 0) + row["outcomes"].value("unseen", 0) +
                           row["outcomes"].value("unsupported", 0) <
                       row["count"].get<int>();
    EXPECT_EQ(row["worst_index"].is_null(), !fails);
    if (!fails || ++failing > 3) continue;
    const Identity id{parse_pair(row["pair"].get<std::string>()), row["class"].get<std::string>(),
                      5, row["worst_index"]};
    const json again = to_json(examine(subject(id), pointers(candidates), Bar()));
    EXPECT_NE(again["answers"][row["candidate"].get<std::string>()]["score"]["outcome"], "agree");
  }
  EXPECT_GT(failing, 0);
}

TEST(Report, TheTablesWorstFailureIsTheOneWithoutAnAnswer) {
  Report report;
  report.candidates = {{"mine", "mine", "1", "", ""}};
  const Configuration any = make_configuration({Pair::plane, "lying", 1, 0});
  const auto add = [&](const char* group, Outcome outcome, double severity, const char* replay) {
    Score score;
    score.outcome = outcome;
    score.severity = severity;
    report.worst.push_back(
        {"cylinder-plane", group, "lying", "mine", score, {"", any, std::nullopt, {}, replay}});
  };
  add("everyday", Outcome::shallow, 5, "first");
  add("everyday", Outcome::crashed, 0, "second");
  add("extreme", Outcome::crashed, 0, "third");
  EXPECT_THAT(terminal_details(report), HasSubstr("mine crashed, everyday\n    second\n"));
}

TEST(Report, TheTableSaysWhichTimeLimitsWereExceeded) {
  Report report;
  ResultRow row;
  row.pair = "all";
  row.pose_class = "everyday";
  row.candidate = "mine";
  row.statistics.count = 1;
  report.summary = {row};
  EXPECT_THAT(terminal_details(report), Not(HasSubstr("timed-out: ")));
  report.summary[0].statistics.outcomes[static_cast<std::size_t>(Outcome::timed_out)] = 1;
  EXPECT_THAT(terminal_details(report), HasSubstr("timed-out: "));
}

TEST(Report, RanksNobodyWithinTheSpreads) {
  const json report = to_json(report_of_some());
  for (const json& row : report["summary"]) {
    const json& time = row["nanoseconds"];
    ASSERT_GE(time["repetitions"], 5);
    ASSERT_LE(time["repetitions"], 11);
    EXPECT_LE(time["low"], time["median"]);
    EXPECT_LE(time["median"], time["high"]);
    EXPECT_LE(time["ratio_low"], time["ratio_to_bullet"]);
    EXPECT_LE(time["ratio_to_bullet"], time["ratio_high"]);
    if (row["candidate"] == "bullet") {
      EXPECT_EQ(time["ratio_high"], 1);
    }
    for (const json& other : report["summary"]) {
      if (other["pair"] != row["pair"] || other["class"] != row["class"]) continue;
      if (other["candidate"] == row["candidate"]) continue;
      const json& theirs = other["nanoseconds"];
      const bool overlap = time["low"] <= theirs["high"] && theirs["low"] <= time["high"];
      const json& ties = row["tied_with"];
      EXPECT_EQ(std::find(ties.begin(), ties.end(), other["candidate"]) != ties.end(), overlap);
    }
    // The most accurate one is on the front.
    if (row["candidate"] == "reference") {
      EXPECT_EQ(row["pareto"], true);
    }
  }
}

// Over all pairs it is over another number of them than the others', and in no order with those.
TEST(Report, MarksWhoHasNoRoutineForSomePairs) {
  Campaign c;
  c.pairs = {Pair::plane, Pair::sphere, Pair::box};
  c.classes = {"general-shallow", "lying"};
  c.candidates = find_candidates({"reference", "bullet", "libccd-gjk"});  // without planes
  c.count = 1;
  const Report report = make_report(c, "x");
  for (const ResultRow& row : report.summary) {
    const bool is_partial = row.pair == "all" && row.candidate == "libccd-gjk";
    if (row.pose_class != "everyday") continue;
    EXPECT_EQ(covered_text(report, row), is_partial ? " (2 of 3 pairs)" : "") << row.pair;
    EXPECT_EQ(row.pareto.has_value(), row.statistics.depth_error.has_value() && !is_partial)
        << row.pair << ' ' << row.candidate;
  }
  for (const std::size_t columns : {40, 80}) {
    const std::string table = terminal_table(report, {columns});
    const std::string details = terminal_details(report, {columns});
    EXPECT_THAT(details, ContainsRegex("all pairs, everyday poses\n.*\n.*\nlibccd-gjk 2/3 +[0-9]"));
    for (const std::string& text : {table, details}) {
      EXPECT_THAT(text, ContainsRegex("\nlibccd-gjk 2/3 +[0-9]"));
      EXPECT_THAT(text, ContainsRegex("\n5/6: over five of six pairs"));
      EXPECT_THAT(text, Not(ContainsRegex("(reference|bullet) ./")));
    }
  }
  c.candidates.pop_back();
  EXPECT_THAT(terminal_table(make_report(c, "x")), Not(HasSubstr("5/6")));
}

TEST(Report, IsOfAPersonsOwnConfigurationsByTheirIds) {
  Campaign c = some_configurations();
  c.pairs = {Pair::plane, Pair::box, Pair::convex};
  c.classes = {};
  const Identity shallow{Pair::plane, "general-shallow", 1, 0};
  c.own[Pair::plane] = {{"on the floor", make_configuration(shallow)},
                        {"2", make_configuration(shallow)}};
  c.own[Pair::box] = {{"3", make_configuration({Pair::box, "rim-face", 1, 0})}};
  c.own[Pair::convex] = {{"4", with_hull(c.own[Pair::box][0].configuration)}};
  c.own_file = "poses.jsonl";
  const Report report = make_report(c, "x");
  EXPECT_EQ(report.configurations, 4u);
  ASSERT_EQ(report.classes.size(), 3u);
  for (const PoseClassDescription& each : report.classes) {
    EXPECT_EQ(each.pose_class, "given");
    EXPECT_EQ(each.digest.size(), 16u);
  }
  ASSERT_FALSE(report.worst.empty());
  for (const WorstCase& worst : report.worst) {
    const Examination& e = worst.examination;
    EXPECT_THAT(e.id, testing::AnyOf("on the floor", "2", "3", "4"));
    EXPECT_THAT(e.replay, testing::StartsWith("./touchstone replay poses.jsonl"));
    EXPECT_THAT(e.replay,
                testing::EndsWith(e.id.size() == 1 ? " --id " + e.id : " --id 'on the floor'"));
  }
  const json read = to_json(report_from_text(to_json(report).dump(), "report"));
  EXPECT_EQ(read["classes"], to_json(report)["classes"]);
}

TEST(Report, InterruptedBeforeTheEndIsOfWhatIsDone) {
  Campaign c = some_configurations(1);
  const Interruption interruption;
  testing::internal::CaptureStderr();
  raise(SIGTERM);
  const Report report = make_report(c, "x");
  testing::internal::GetCapturedStderr();
  EXPECT_TRUE(report.partial);
  EXPECT_TRUE(report.results.empty());
  EXPECT_EQ(report.completed.classes, 0u);
  EXPECT_EQ(report.completed.configurations, 0u);
  EXPECT_EQ(report.timed_classes, 0u);
  EXPECT_EQ(report.planned.classes, 5u);
  EXPECT_EQ(report.planned.configurations, 20u);
  EXPECT_THAT(terminal_table(report), HasSubstr("PARTIAL: interrupted when 0 of 5"));
}

TEST(Report, TellsAModelsErrorFromItsSolvers) {
  const json report = to_json(report_of_some());
  for (const json& row : report["results"]) {
    const bool is_prism = row["candidate"] == "prism:8", is_rounded = row["candidate"] == "bullet";
    const bool is_missed = row["outcomes"].value("missed", 0) > 0;
    const bool has_errors = !row["depth_error"].is_null() || is_missed;
    EXPECT_EQ(row["model_error"].is_null(), !(is_prism || is_rounded) || !has_errors);
    if (row["model_error"].is_null()) continue;
    const double of_model = row["model_error"]["max"], of_solver = row["solver_error"]["max"];
    if (!is_prism) continue;
    // The prism is answered exactly: its error is the model's, also of what it misses.
    EXPECT_LE(of_solver, 0);
    const double of_contacts =
        row["depth_error"].is_null() ? 0 : row["depth_error"]["max"].get<double>();
    EXPECT_GE(of_model, of_contacts);
    EXPECT_TRUE(is_missed || of_model == of_contacts);
  }
}

TEST(Report, EveryWorstCaseReplaysToTheSameAnswers) {
  const json report = to_json(report_of_some());
  ASSERT_FALSE(report["worst"].empty());
  auto candidates = start(some_configurations().candidates, 0);
  for (const json& w : report["worst"]) {
    const Identity id = parse_identity(w["id"].get<std::string>());
    const json again = to_json(examine(subject(id), pointers(candidates), Bar()));
    EXPECT_TRUE(w["answers"].contains(w["candidate"]));
    for (const auto& [name, answer] : w["answers"].items()) {
      EXPECT_EQ(again["answers"][name], answer) << name;
    }
    EXPECT_EQ(again["configuration"], w["configuration"]);
    EXPECT_EQ(again["truth"], w["truth"]);
  }
}

TEST(Report, IsWrittenAsAWhole) {
  const OwnFolder own;
  const std::filesystem::path folder = own.path / "report test";
  write_report(report_of_some(), folder);
  std::ifstream file(folder / "report.json");
  EXPECT_EQ(json::parse(file)["schema"], report_schema);
  EXPECT_TRUE(std::filesystem::exists(folder / "report.html"));
  EXPECT_FALSE(std::filesystem::exists(folder / "report.json.partial"));
}

TEST(Report, ScoresMoreOfWhatUsersAskOfFirst) {
  Campaign c;
  c.count = 20;
  const auto count = [&](const char* name) { return count_of(c, {Pair::cylinder, name}); };
  EXPECT_EQ(count("rim-rim"), 20u);
  c.everyday_times = 5;
  for (const char* name :
       {"rim-rim", "recorded", "parallel-side+turned", "parallel-side+aligned"}) {
    EXPECT_EQ(count(name), 100u) << name;
  }
  for (const char* name : {"parallel-side", "general+needle", "parallel-side+aligned+tiny"}) {
    EXPECT_EQ(count(name), 20u) << name;
  }
}

TEST(Report, RefusesAnUnknownClassBeforeAnyWork) {
  Campaign c = some_configurations();
  c.classes = {"rim-rimm"};
  EXPECT_THAT([&] { cells(c); }, testing::ThrowsMessage<InvalidInput>(testing::AllOf(
                                     HasSubstr("rim-rimm"), HasSubstr("rim-face, "))));
}

TEST(Report, RefusesAFolderThatIsAFile) {
  const OwnFolder own;
  EXPECT_THROW(check_writable(own.with("file", "x")), InvalidInput);
}

/// Poses some 26 m from the origin, rounded to doubles.
constexpr double rounding = 26 * 0x1p-50;

TEST(DrakeProtocol, EveryPairIsTwoMillimetresDeep) {
  for (const Pair pair : all_pairs) {
    for (const DrakeCase& c : drake_cases(pair)) {
      EXPECT_EQ(pair_of(c.configuration), pair);
      EXPECT_NEAR(oracle::truth(c.configuration).signed_distance.midpoint(), -2e-3, rounding)
          << pair_name(pair) << ": " << c.description;
    }
  }
}

TEST(DrakeProtocol, HasDrakesNumberOfPoses) {
  // Two worlds; an edge or a vertex meets no other edge or vertex.
  EXPECT_EQ(drake_cases(Pair::plane).size(), 2u * 3);
  EXPECT_EQ(drake_cases(Pair::sphere).size(), 2u * 6);
  EXPECT_EQ(drake_cases(Pair::capsule).size(), 2u * 6);
  EXPECT_EQ(drake_cases(Pair::cylinder).size(), 2u * 8 * 2);
  EXPECT_EQ(drake_cases(Pair::box).size(), 2u * 7);
}

TEST(DrakeProtocol, ReportsTheWorstErrorAndItsPose) {
  Campaign campaign{.pairs = {Pair::plane, Pair::box},
                    .candidates = find_candidates({"reference", "bullet"})};
  auto candidates = start(campaign.candidates, campaign.bar.threshold, campaign.limits);
  const DrakeProtocol protocol = drake_protocol(campaign, candidates);
  ASSERT_EQ(protocol.results.size(), 4u);
  EXPECT_EQ(protocol.pairs[1].penetration, 1e-3);
  const DrakeProtocol::Result& ours = protocol.results[2];
  EXPECT_EQ(ours.candidate, "reference");
  EXPECT_EQ(ours.outcomes, (std::map<Outcome, std::uint64_t>{{Outcome::agree, 14}}));
  EXPECT_LT(ours.max_error, rounding);
  // Bullet rounds edges by its margin: more than Drake's published error, less than its margin.
  const DrakeProtocol::Result& bullet = protocol.results[3];
  EXPECT_GT(bullet.max_error, 1e-5);
  EXPECT_LT(bullet.max_error, 0.04);
  EXPECT_LT(bullet.worst, protocol.pairs[1].configurations.size());
}

}  // namespace
}  // namespace touchstone
