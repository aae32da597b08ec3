#include <csignal>
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/testing/hostile.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/small_report_test.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

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
  const auto at = reinterpret_cast<const HostileDeed* (*)(int)>(dlsym(library, "hostile_deed"));
  int i = 0;
  while (at(i) && at(i)->name != deed) ++i;
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

}  // namespace
}  // namespace touchstone
