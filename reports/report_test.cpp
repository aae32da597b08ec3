#include <cmath>
#include <csignal>
#include <dlfcn.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

#include <nlohmann/json.hpp>

#include "candidates/host/interruption.hpp"
#include "oracle/truth.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/covered_pairs.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/small_report_test.hpp"
#include "reports/solve.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

json report_of(const Campaign& campaign) { return to_json(make_report(campaign, "x")); }

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
      EXPECT_THAT(text, ContainsRegex("\n4/5: over four of five pairs"));
      EXPECT_THAT(text, Not(ContainsRegex("(reference|bullet) ./")));
    }
  }
  c.candidates.pop_back();
  EXPECT_THAT(terminal_table(make_report(c, "x")), Not(HasSubstr("4/5")));
}

TEST(Report, IsOfAPersonsOwnConfigurationsByTheirIds) {
  Campaign c = some_configurations();
  c.pairs = {Pair::plane, Pair::box};
  c.classes = {};
  const Identity shallow{Pair::plane, "general-shallow", 1, 0};
  c.own[Pair::plane] = {{"on the floor", make_configuration(shallow)},
                        {"2", make_configuration(shallow)}};
  c.own[Pair::box] = {{"3", make_configuration({Pair::box, "rim-face", 1, 0})}};
  c.own_file = "poses.jsonl";
  const Report report = make_report(c, "x");
  EXPECT_EQ(report.configurations, 3u);
  ASSERT_EQ(report.classes.size(), 2u);
  for (const PoseClassDescription& each : report.classes) {
    EXPECT_EQ(each.pose_class, "given");
    EXPECT_EQ(each.digest.size(), 16u);
  }
  ASSERT_FALSE(report.worst.empty());
  for (const WorstCase& worst : report.worst) {
    const Examination& e = worst.examination;
    EXPECT_THAT(e.id, testing::AnyOf("on the floor", "2", "3"));
    EXPECT_THAT(e.replay, testing::StartsWith("./touchstone replay poses.jsonl"));
    EXPECT_THAT(e.replay, testing::EndsWith(e.id == "2" || e.id == "3" ? " --id " + e.id
                                                                       : " --id 'on the floor'"));
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
    const bool is_model = row["candidate"] == "prism:8";
    EXPECT_EQ(row["model_error"].is_null(), !is_model || row["depth_error"].is_null());
    if (!is_model || row["model_error"].is_null()) continue;
    // The prism is answered exactly: its error is the model's.
    EXPECT_LE(row["solver_error"]["max"], 0);
    EXPECT_EQ(row["model_error"]["max"], row["depth_error"]["max"]);
  }
}

/// A candidate that crashes, aborts, throws, allocates 10 GiB, answers NaN, long normals and a
/// million points on one configuration in three.
const Candidate& sabotage() {
  add_test_plugin("touchstone-sabotage.so");
  return find_candidate("sabotage");
}

TEST(Report, PrintsCommandsWithTheOptionsOfTheirOwnCandidatesAlone) {
  add_test_plugin("touchstone-sabotage.so");
  add_test_plugin("touchstone-hostile.so");
  for (const char* name : {"hostile:2", "prism:5"}) find_candidate(name);  // known from now on
  const auto added = [](const char* name) {
    return "./touchstone --load " +
           (std::filesystem::canonical(TOUCHSTONE_TEST_PLUGINS) / name).string();
  };
  EXPECT_EQ(replay_command("a/b/1/2", {"reference", "bullet"}), "./touchstone replay a/b/1/2");
  EXPECT_EQ(replay_command("a/b/1/2", {"reference", "sabotage", "obedient"}),
            added("touchstone-sabotage.so") + " replay a/b/1/2");
  EXPECT_EQ(program_name({"hostile:2"}), added("touchstone-hostile.so"));
  // What is asked only when it is named has to be named.
  EXPECT_EQ(replay_command("a/b/1/2", {"reference", "prism:5"}),
            "./touchstone replay a/b/1/2 --candidates reference,'prism:5'");
  EXPECT_EQ(replay_command("a/b/1/2", {"fcl-indep"}),
            "./touchstone replay a/b/1/2 --candidates fcl-indep");
  std::vector<std::string> all;
  for (const Candidate* c : all_candidates()) all.push_back(c->name);
  EXPECT_THAT(replay_command("a/b/1/2", all),
              testing::EndsWith(" replay a/b/1/2 --all-candidates"));
}

TEST(Report, IsCompleteWhateverACandidateDoes) {
  Campaign c = some_configurations();
  c.count = 40;
  c.pairs = {Pair::plane, Pair::cylinder};
  c.limits.seconds = 10;  // sanitizers take their time over a crash
  const json alone = without_times(report_of(c));
  c.candidates.push_back(&sabotage());
  const json together = without_times(report_of(c));
  // Each misdeed is counted …
  std::map<std::string, int> outcomes;
  std::size_t sum = 0;
  for (const json& row : together["results"]) {
    if (row["candidate"] != "sabotage") continue;
    for (const auto& [name, count] : row["outcomes"].items()) {
      outcomes[name] += count.get<int>();
      sum += count.get<std::size_t>();
    }
  }
  EXPECT_EQ(sum, together["configurations"]);
  for (const char* name : {"crashed", "not-finite", "failed"}) EXPECT_GT(outcomes[name], 3) << name;
  // … and can be replayed: its identity stands among the worst, and gives the same again.
  std::map<std::string, int> shown;
  auto processes = start({&sabotage()}, 0);
  for (const json& w : together["worst"]) {
    if (w["candidate"] != "sabotage") continue;
    ++shown[w["outcome"]];
    const json again = to_json(
        examine(subject(parse_identity(w["id"].get<std::string>())), pointers(processes), Bar()));
    EXPECT_EQ(again["answers"]["sabotage"], w["answers"]["sabotage"]);
    EXPECT_THAT(w["replay"].get<std::string>(), HasSubstr("--load"));
  }
  for (const char* name : {"crashed", "not-finite", "failed"}) EXPECT_GT(shown[name], 0) << name;
  // The others lose nothing.
  json others = json::array();
  for (const json& row : together["results"]) {
    if (row["candidate"] != "sabotage") others.push_back(row);
  }
  EXPECT_EQ(others, alone["results"]);
  // And it is the same whatever the number of workers.
  c.workers = 1;
  EXPECT_EQ(without_times(report_of(c)), together);
}

/// The candidate that does what testing/hostile.cpp calls by this name.
const Candidate* hostile(const std::string& deed) {
  static void* const library = dlopen(TOUCHSTONE_TEST_PLUGINS "/touchstone-hostile.so", RTLD_NOW);
  const auto name = reinterpret_cast<const char* (*)(int)>(dlsym(library, "hostile_deed"));
  int i = 0;
  while (name(i) && name(i) != deed) ++i;
  return &find_candidate("hostile:" + std::to_string(i + 1));
}

TEST(Report, IsCompleteWithHostileCandidates) {
  add_test_plugin("touchstone-hostile.so");
  setenv("TOUCHSTONE_HOSTILE_EVERYWHERE", "1", 1);
  Campaign c = some_configurations();
  c.count = 1;
  c.pairs = {Pair::plane};
  c.classes = {"general-shallow", "touching"};
  c.candidates = find_candidates({"reference"});
  for (const char* deed :
       {"exit", "SIGSTOP", "fork, both pause", "fork, both return", "daemon",
        "write to all descriptors", "close all descriptors", "interrupt the group",
        "kill the parent", "stop the parent", "overwrite shared memory with zeros"}) {
    c.candidates.push_back(hostile(deed));
  }
  const json report = report_of(c);
  unsetenv("TOUCHSTONE_HOSTILE_EVERYWHERE");
  EXPECT_FALSE(report.value("partial", false));
  EXPECT_EQ(report["results"].size(), report["classes"].size() * c.candidates.size());
  for (const json& row : report["results"]) {
    std::size_t outcomes = 0;
    for (const json& n : row["outcomes"]) outcomes += n.get<std::size_t>();
    EXPECT_EQ(outcomes, 1u) << row["candidate"];
    if (row["candidate"] == "reference") {
      EXPECT_EQ(row["outcomes"]["agree"], 1);
    }
  }
}

TEST(Report, AHangCostsOneConfigurationEach) {
  sabotage();
  Campaign c = some_configurations();
  c.classes = {"touching"};
  c.pairs = {Pair::plane};
  c.count = max_timeouts;  // beyond these it is stopped
  c.limits.seconds = 0.05;
  c.candidates = find_candidates({"reference", "misdeed:5"});
  const json report = report_of(c);
  EXPECT_EQ(report["results"][0]["outcomes"], json({{"agree", max_timeouts}}));
  EXPECT_EQ(report["results"][1]["outcomes"], json({{"timed-out", max_timeouts}}));
  EXPECT_TRUE(report["results"][1]["nanoseconds"].is_null());
}

TEST(Report, ACandidateThatHangsIsStoppedAndTheTableSaysHowMuchItWasAsked) {
  sabotage();
  Campaign c = some_configurations(1);
  c.classes = {"touching"};
  c.pairs = {Pair::plane};
  c.count = 40;
  c.is_timed = false;
  c.limits.seconds = 0.01;
  c.candidates = find_candidates({"reference", "misdeed:5"});
  const Report report = make_report(c, "x");
  const json written = to_json(report);
  EXPECT_EQ(written["results"][0]["outcomes"], json({{"agree", 40}}));
  for (const char* list : {"results", "summary"}) {
    const json& row = written[list][1];
    EXPECT_EQ(row["count"], 40);
    EXPECT_EQ(row["outcomes"], json({{"timed-out", 3}, {"not-asked", 37}}));
  }
  EXPECT_THAT(terminal_table(report), HasSubstr(">=0.0"));
  EXPECT_THAT(terminal_table(report), HasSubstr("\n>=: stopped after 3 time-outs"));
  EXPECT_THAT(terminal_details(report),
              HasSubstr("misdeed:5: 3 time-outs; 3 of 40 asked in 1 pose class"));
  const json read = to_json(report_from_text(written.dump(), "report"));
  EXPECT_EQ(read["results"][1]["outcomes"], written["results"][1]["outcomes"]);
  c.workers = 3;
  EXPECT_EQ(without_times(report_of(c)), without_times(written));
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
  const std::filesystem::path folder = testing::TempDir() + "touchstone report test";
  write_report(report_of_some(), folder);
  std::ifstream file(folder / "report.json");
  EXPECT_EQ(json::parse(file)["schema"], report_schema);
  EXPECT_TRUE(std::filesystem::exists(folder / "report.html"));
  EXPECT_FALSE(std::filesystem::exists(folder / "report.json.partial"));
  std::filesystem::remove_all(folder);
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
  const std::filesystem::path file = testing::TempDir() + "touchstone_is_a_file";
  std::ofstream(file) << "x";
  EXPECT_THROW(check_writable(file), InvalidInput);
  std::filesystem::remove(file);
}

TEST(Replay, IsTheSameOnEveryCall) {
  const Identity id{Pair::cylinder, "rim-rim", 1, 2};
  auto candidates = start(some_configurations().candidates, 0),
       again = start(some_configurations().candidates, 0);
  const auto shown = [&](std::vector<CandidateProcess>& processes) {
    return replay_text(examine(subject(id), pointers(processes), Bar()), "", true);
  };
  const std::string text = shown(candidates);
  EXPECT_EQ(shown(again), text);
  EXPECT_THAT(text, HasSubstr("cylinder-cylinder/rim-rim/1/2"));
  EXPECT_THAT(text, HasSubstr("0x1."));
}

TEST(Replay, InShortIsATableWithTheTruth) {
  const Identity id{Pair::plane, "standing", 1, 2};
  auto candidates = start(some_configurations().candidates, 0);
  const std::string text =
      replay_text(examine(subject(id), pointers(candidates), Bar()), "", false);
  EXPECT_THAT(text, ContainsRegex("\ntruth +-?[0-9.e-]+\n"));
  EXPECT_THAT(text, ContainsRegex("\nreference [(]Touchstone's own[)]\n +agree +-?[0-9]"));
  EXPECT_THAT(text, ContainsRegex("\nprism:8 +[a-z-]+"));
  EXPECT_THAT(text, Not(HasSubstr("  point (")));
}

// solve

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

// Drake's protocol

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
