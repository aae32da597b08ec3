// Every kind of sabotage in testing/sabotage.cpp affects only the configuration on which it
// happens.
#include "candidates/host/candidate_process.hpp"

#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <string>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "candidates/host/exchange.hpp"
#include "candidates/host/watch.hpp"
#include "candidates/testing/plain_contacts.hpp"
#include "oracle/hull.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const Configuration standing = plain_contacts()[0].configuration;

const Candidate& sabotage(const std::string& name) {
  static const bool added = (add_file(TOUCHSTONE_TEST_PLUGINS "/touchstone-sabotage.so"), true);
  (void)added;
  return find_candidate(name);
}

Answer after_misdeed(int deed, const Limits& limits = {10, 256}) {
  CandidateProcess process(sabotage("misdeed:" + std::to_string(deed)), 0, limits);
  return process.answer(standing);
}

// How other deeds end, hostile_test.cpp holds.
TEST(CandidateProcess, SaysHowAMisdeedEnded) {
  const struct {
    int deed;
    ts_status status;
    testing::Matcher<std::string> reason;
    double seconds = 10;
  } misdeeds[] = {{3, TS_CRASHED, "threw no convergence"},
                  {5, TS_TIMED_OUT, "no answer within 0.1 s", 0.1},
                  {9, TS_CRASHED, testing::_},  // a million points, written
                  {10, TS_FAILED, ""},          // and claimed
                  {15, TS_CRASHED, "threw no text ??"}};
  for (const auto& [deed, status, reason, seconds] : misdeeds) {
    const Answer a = after_misdeed(deed, {seconds, 256});
    EXPECT_EQ(a.status, status) << deed;
    EXPECT_THAT(a.reason, reason) << deed;
    EXPECT_EQ(a.point_count, 0) << deed;
  }
}

TEST(CandidateProcess, WaitsAsLongWhateverItWaitedForBefore) {
  CandidateProcess process(sabotage("misdeed:6"), 0, {0.01, 256});
  const std::string first = process.answers({&standing, 1}).at(0).reason;
  EXPECT_EQ(process.answers({&standing, 1}).at(0).reason, first);
}

/// Configurations with A at these x.
std::vector<Configuration> standing_at(const std::vector<double>& at) {
  std::vector<Configuration> result;
  for (const double x : at) {
    result.push_back({standing.a, Pose({x, 0, 1.9}, upright), standing.b, standing.pose_b});
  }
  return result;
}

/// Answers of the candidate stalling.
std::vector<Answer> after_stalling(CandidateProcess& process, const std::vector<double>& at) {
  return process.answers(standing_at(at));
}

constexpr double at_once = 0, endless = -1, slow = 2;

TEST(CandidateProcess, ATimeOutLowersTheLimitForTheRestOfTheCall) {
  CandidateProcess process(sabotage("stalling"), 0, {0.2, 256});
  std::vector<double> at(30, at_once);
  at[1] = at[20] = at[21] = at[25] = endless;
  for (int call = 0; call < 2; ++call) {
    const auto answers = after_stalling(process, at);
    for (std::size_t i = 0; i < at.size(); ++i) {
      EXPECT_EQ(answers[i].status, at[i] == endless ? TS_TIMED_OUT : TS_CONTACT) << i;
    }
    EXPECT_EQ(answers[1].reason, "no answer within 0.2 s");
    for (const int i : {20, 21, 25}) {
      EXPECT_EQ(answers[i].reason, "no answer within 0.02 s and a hundred times its median") << i;
    }
  }
}

// As on a machine that is so busy that making a process takes longer than an answer may.
TEST(CandidateProcess, ATimeOutCountsOnlyIfAnotherSessionTimesOutAsWell) {
  CandidateProcess process(sabotage("hiccuping"), 0, {0.1, 256});
  EXPECT_EQ(process.answers({&standing, 1}).at(0).status, TS_CONTACT);
}

TEST(CandidateProcess, SlowAnswersCountUnlessAnAnswerHasTimedOut) {
  CandidateProcess process(sabotage("stalling"), 0, {0.02, 256});
  std::vector<double> at(20, at_once);
  at.push_back(slow);
  EXPECT_EQ(after_stalling(process, at).back().status, TS_CONTACT);
  at[19] = endless;
  const auto answers = after_stalling(process, at);
  EXPECT_EQ(answers[19].status, TS_TIMED_OUT);
  EXPECT_EQ(answers.back().status, TS_TIMED_OUT);
}

TEST(CandidateProcess, ThreeTimeOutsLowerTheLimitOfACandidateThatHardlyEverAnswers) {
  CandidateProcess process(sabotage("stalling"), 0, {0.1, 256});
  const auto never = after_stalling(process, std::vector<double>(5, endless));
  EXPECT_EQ(never[2].reason, "no answer within 0.1 s");
  EXPECT_EQ(never[3].reason, "no answer within 0.01 s, as others within 0.1 s");
  EXPECT_EQ(never[4].reason, never[3].reason);
  // A single slow answer is known to be its kind.
  const auto rarely = after_stalling(process, {slow, endless, endless, endless, slow});
  EXPECT_EQ(rarely[4].status, TS_CONTACT);
}

// So that the runs of an experiment do not depend on which of them the same worker had before.
TEST(CandidateProcess, ARestartForgetsTimeOuts) {
  CandidateProcess process(sabotage("stalling"), 0, {0.1, 256});
  const auto never = standing_at(std::vector<double>(4, endless));
  EXPECT_EQ(process.answer(never)[3].reason, "no answer within 0.01 s, as others within 0.1 s");
  process.restart();
  EXPECT_EQ(process.answer(never)[0].reason, "no answer within 0.1 s");
}

TEST(CandidateProcess, AnswersUntilOneTimesOutAndGoesOnInTheSameSession) {
  CandidateProcess process(sabotage("stalling"), 0, {0.05, 256});
  std::vector<double> at(150, at_once);  // more than one message
  at[2] = at[100] = endless;
  const std::vector<Configuration> asked = standing_at(at);
  const std::span all(asked);
  const auto first = process.answers_until_timeout(all, true);
  ASSERT_EQ(first.size(), 3u);
  EXPECT_EQ(first[1].status, TS_CONTACT);
  EXPECT_EQ(first[2].status, TS_TIMED_OUT);
  const auto second = process.answers_until_timeout(all.subspan(3), false);
  ASSERT_EQ(second.size(), 98u);
  // What was learnt in the first call holds in the second.
  EXPECT_EQ(second.back().reason, "no answer within 0.005 s and a hundred times its median");
  EXPECT_EQ(process.answers_until_timeout(all.subspan(101), false).size(), 49u);

  CandidateProcess counting(sabotage("counting"), 0);
  for (const bool in_new_session : {true, false, true}) {
    const double prepared =
        -counting.answers_until_timeout(all.first(1), in_new_session)[0].signed_distance;
    EXPECT_EQ(prepared, in_new_session ? 1 : 2);
  }
}

TEST(CandidateProcess, TheLimitOfACandidateThatIsAlwaysSlowStays) {
  CandidateProcess process(sabotage("stalling"), 0, {0.09, 256});
  std::vector<double> at(16, slow);
  at.insert(at.end(), {endless, slow, endless});
  const auto answers = after_stalling(process, at);
  EXPECT_EQ(answers[16].reason, "no answer within 0.09 s");
  EXPECT_EQ(answers[17].status, TS_CONTACT);
  EXPECT_EQ(answers[18].reason, "no answer within 0.09 s");
}

TEST(CandidateProcess, PassesOnNonsenseForTheScoreToJudge) {
  EXPECT_TRUE(std::isnan(after_misdeed(11).normal[0]));
  EXPECT_EQ(after_misdeed(12).normal[2], 2);
}

TEST(CandidateProcess, MemoryThatGrowsIsStoppedAndStartsAgain) {
  CandidateProcess process(sabotage("misdeed:14"), 0, {1, 256});
  const std::vector<Configuration> many(10, standing);
  const auto answers = process.answers(many);
  ASSERT_EQ(answers.size(), 10u);
  // Three times 64 MiB fit; the fourth costs its configuration, and the next starts empty.
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(answers[i].status, i % 4 == 3 ? TS_CRASHED : TS_CONTACT) << i;
  }
}

TEST(CandidateProcess, AMisdeedCostsOneConfigurationOfABatch) {
  // Sanitizers take their time over a crash.
  CandidateProcess process(sabotage("sabotage"), 0, {10, 256});
  std::vector<Configuration> many;
  for (int i = 0; i < 150; ++i) {
    many.push_back({standing.a, Pose({0.37 * i, 0, 1.9}, upright), standing.b, standing.pose_b});
  }
  const auto together = process.answers(many);
  ASSERT_EQ(together.size(), many.size());
  int crashed = 0;
  for (std::size_t i = 0; i < many.size(); ++i) {
    const Answer alone = process.answer(many[i]);
    EXPECT_EQ(alone.status, together[i].status) << i;
    EXPECT_EQ(alone.reason, together[i].reason) << i;
    crashed += together[i].status == TS_CRASHED;
  }
  EXPECT_GT(crashed, 10);
  EXPECT_LT(crashed, 60);
}

TEST(CandidateProcess, HandsThePreviousNormalOnOnce) {
  CandidateProcess process(sabotage("obedient"), 0);
  const Vec3 previous(0, 0.6, -0.8);
  EXPECT_EQ(normal_of(process.answer(standing)), Vec3::UnitZ());
  EXPECT_EQ(normal_of(process.answer(standing, &previous)), previous);
  EXPECT_EQ(normal_of(process.answer(standing)), Vec3::UnitZ());
  const auto answers = process.answers({&standing, 1});
  EXPECT_EQ(normal_of(answers.at(0)), Vec3::UnitZ());
}

TEST(CandidateProcess, PreparesShapesOnceForManyPosesAndKeepsFewOfThem) {
  CandidateProcess process(sabotage("counting"), 0);
  const auto ask = [&](double radius, double height) {
    return process.answer({Cylinder(radius, 1), Pose({0, 0, height}, upright), standing.b, {}});
  };
  for (const double height : {0.9, 0.8, 0.7}) {  // two bodies in turn, as in a world
    ask(0.5, height);
    EXPECT_EQ(ask(0.25, height).signed_distance, -2);
  }
  for (int i = 1; i <= 100; ++i) ask(i, 0.9);
  const Answer last = ask(0.5, 0.9);
  EXPECT_EQ(last.signed_distance, -103);  // so long ago that it was prepared anew
  EXPECT_LT(last.points[0].depth, 20);    // pairs that are not released
}

TEST(CandidateProcess, AnotherThresholdPreparesShapesAnewInTheSameSession) {
  CandidateProcess process(sabotage("counting"), 0);
  EXPECT_EQ(process.answer(standing).signed_distance, -1);
  const std::vector<Configuration> thrice(3, standing);
  const auto answers = process.answer(thrice, {}, std::vector{0.0, 0.5, 0.0});
  EXPECT_EQ(answers.at(0).signed_distance, -1);  // as before
  EXPECT_EQ(answers.at(1).signed_distance, -2);  // counted in the session
  EXPECT_EQ(answers.at(2).signed_distance, -2);  // both are kept
  process.ask_within(0);
  EXPECT_EQ(process.answer(standing).signed_distance, -1);
}

TEST(CandidateProcess, ReleasesShapesWithinASession) {
  CandidateProcess process(sabotage("counting"), 0);
  const auto ask = [&] { return process.answer(standing); };
  process.release_shapes();  // of no session
  EXPECT_EQ(ask().signed_distance, -1);
  EXPECT_EQ(ask().signed_distance, -1);
  process.release_shapes();
  const Answer anew = ask();
  EXPECT_EQ(anew.signed_distance, -2);  // counted in the session
  EXPECT_EQ(anew.points[0].depth, 1);   // of those not released
  EXPECT_EQ(ask().signed_distance, -2);
}

TEST(CandidateProcess, IsTimedWhereTheHarnessMayRun) {
  CandidateProcess process(sabotage("counting"), 0);
  const auto processors = [&] {
    EXPECT_TRUE(process.prepare_timing({&standing, 1}));
    return process.answer(standing).points[0].position[0];
  };
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  EXPECT_EQ(processors(), CPU_COUNT(&all));
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(processors(), 1);
  ASSERT_EQ(sched_setaffinity(0, sizeof all, &all), 0);
}

TEST(CandidateProcess, LeavesNoFileOpen) {
  const auto open_files = [] {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      count += entry.exists();
    }
    return count;
  };
  after_misdeed(16);
  const int before = open_files();
  for (int deed : {1, 3, 8, 16}) after_misdeed(deed);
  EXPECT_EQ(open_files(), before);
}

TEST(CandidateProcess, TimesTheQueriesAndNothingElse) {
  // The answer takes a few stores, so that the microseconds of a round trip between processes would
  // show.
  CandidateProcess process(sabotage("misdeed:16"), 0);
  const std::vector<Configuration> many(200, standing);
  ASSERT_TRUE(process.prepare_timing(many));
  double min_nanoseconds = 1e9, min_instructions = 1e9;
  for (int i = 0; i < 9; ++i) {
    const QueryCost cost = process.cost_per_query().value();
    min_nanoseconds = std::min(min_nanoseconds, cost.nanoseconds);
    EXPECT_LT(cost.tail.value(), 200);
    // Absent where instructions cannot be counted; otherwise a few dozen per query.
    min_instructions = std::min(min_instructions, cost.instructions.value_or(20));
  }
  EXPECT_GT(min_instructions, 5);
  EXPECT_LT(min_instructions, 500);
  EXPECT_GT(min_nanoseconds, 0);
  EXPECT_LT(min_nanoseconds, 200);
}

TEST(CandidateProcess, TimesWhatIsSlowButWithinTheLimit) {
  // A round takes at least ten queries of ten milliseconds.
  CandidateProcess process(sabotage("misdeed:17"), 0, {0.05, 256});
  ASSERT_TRUE(process.prepare_timing(std::vector<Configuration>(20, standing)));
  const auto cost = process.cost_per_query();
  ASSERT_TRUE(cost);
  EXPECT_GT(cost->nanoseconds, 9e6);
}

TEST(CandidateProcess, ATailLeavesOutOneQueryInTwentyAndNoMore) {
  const auto tail = [](std::size_t slow_one) {
    std::vector<double> at(20, at_once);
    at[slow_one] = slow;
    CandidateProcess process(sabotage("stalling"), 0);
    EXPECT_TRUE(process.prepare_timing(standing_at(at)));
    EXPECT_TRUE(process.cost_per_query());
    return process.cost_per_query().value().tail.value();
  };
  EXPECT_LT(tail(19), 1e6);
  EXPECT_GT(tail(5), 9e6);  // only the first ten are kept: they take long
}

TEST(CandidateProcess, TimesOnlyWhatItWasLastPreparedFor) {
  // More often than one session serves.
  CandidateProcess process(sabotage("stalling"), 0);
  for (int i = 0; i < 18; ++i) {
    const double at = i % 9 == 0 ? slow : at_once;
    ASSERT_TRUE(process.prepare_timing(standing_at({at, at})));
    const QueryCost cost = process.cost_per_query().value();
    EXPECT_EQ(cost.nanoseconds > 9e6, at == slow) << i;
    EXPECT_EQ(cost.tail.value() > 9e6, at == slow) << i;
  }
}

TEST(CandidateProcess, ATimingThatEndedItsSessionDoesNotHarmTheNext) {
  CandidateProcess process(sabotage("stalling"), 0, {0.02, 256});
  ASSERT_TRUE(process.prepare_timing(standing_at({at_once})));
  EXPECT_FALSE(process.prepare_timing(standing_at({at_once, endless})));
  EXPECT_FALSE(process.cost_per_query());
  ASSERT_TRUE(process.prepare_timing(standing_at({at_once})));
  EXPECT_TRUE(process.cost_per_query());
}

TEST(CandidateProcess, ACrashWhileTimingIsNoTime) {
  CandidateProcess process(sabotage("misdeed:1"), 0);
  EXPECT_FALSE(process.prepare_timing(std::vector<Configuration>(3, standing)));
  EXPECT_FALSE(process.cost_per_query());
}

const Candidate& of_plugin(const char* file, const std::string& name) {
  const auto path = std::filesystem::canonical(TOUCHSTONE_TEST_PLUGINS) / file;
  const auto is = [&](const Added& a) { return a.value == path.string(); };
  if (std::none_of(added_candidates().begin(), added_candidates().end(), is)) add_file(path);
  return find_candidate(name);
}

/// A pyramid over that many corners, whose tip is the first vertex.
Convex pyramid(int corners, double height) {
  std::vector<Vec3> points = {{0, 0, height}};
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return oracle::convex_hull(points);
}

Configuration beside(const Convex& body) {
  return {Cylinder(1, 1), Pose({3, 0, 0}, upright), body, Pose()};
}

TEST(PluginProcess, OneMadeForAnEarlierVersionIsAskedAboutTheShapesThatItKnows) {
  const Configuration sphere{Cylinder(1, 1), Pose(), Sphere(1), Pose()};
  for (const std::string version : {"3", "4"}) {
    const std::string file = "touchstone-version_" + version + ".so", name = "old-" + version;
    CandidateProcess first(of_plugin(file.c_str(), name + "-one:5"), 0.25);
    EXPECT_EQ(first.answer(sphere).signed_distance, -5.25) << name;
    EXPECT_EQ(first.answer(standing).status, TS_UNSUPPORTED) << name;
    EXPECT_EQ(first.answer(beside(pyramid(4, 1))).status, TS_UNSUPPORTED) << name;
    CandidateProcess second(of_plugin(file.c_str(), name + "-two"), 0.25);
    EXPECT_EQ(second.answer(sphere).signed_distance, -0.25) << name;
  }
}

/// As the candidate weighing answers.
double weight(const Convex& body) {
  double sum = 0;
  int place = 0;
  for (const Vec3& v : body.vertices()) {
    for (const double x : v) sum += ++place * x;
  }
  for (const Convex::Face& face : body.faces()) {
    sum += ++place * static_cast<double>(face.vertices.size());
    for (const int i : face.vertices) sum += ++place * i;
  }
  return sum;
}

// Pointers lead nowhere in another process.
TEST(CandidateProcess, GivesEveryQuestionItsConvexBody) {
  std::vector<Configuration> asked;
  for (int i = 0; i < static_cast<int>(batch_size) + 5; ++i) {  // of neighbours some are the same
    const int height = 1 + i / 3;
    asked.push_back(beside(pyramid(3 + i / 2 % 5, height)));
  }
  asked[7] = beside(oracle::convex_hull({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}));
  asked[8] = standing;
  const auto right = [](const Configuration& c) {
    const auto* const body = std::get_if<Convex>(&c.b);
    return body ? weight(*body) : 0;
  };
  CandidateProcess process(sabotage("weighing"), 0);
  const std::vector<Answer> answers = process.answers(asked);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(answers[i].signed_distance, right(asked[i])) << i;
  }
  for (const Configuration& c : asked) {  // some of which are ready
    EXPECT_EQ(process.answer(c).signed_distance, right(c));
  }
  EXPECT_TRUE(process.prepare_timing(asked));
  EXPECT_TRUE(process.cost_per_query());
}

TEST(CandidateProcess, GivesTheLargestConvexBodies) {
  // Two tips over a polygon: as many faces and edges as there may be.
  constexpr int corners = static_cast<int>(Convex::max_vertices) - 2;
  std::vector<Vec3> vertices = {{0, 0, 1}, {0, 0, -1}};
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    const int here = 2 + i, next = 2 + (i + 1) % corners;
    faces.insert(faces.end(), {{here, next, 0}, {next, here, 1}});
  }
  const Configuration c = beside(Convex(vertices, faces));
  CandidateProcess process(sabotage("weighing"), 0);
  for (const Answer& a : process.answers(std::vector(batch_size, c))) {
    EXPECT_EQ(a.signed_distance, weight(std::get<Convex>(c.b)));
  }
}

class Threads : public testing::TestWithParam<const char*> {
 protected:
  static const Candidate& member(const std::string& parameter) {
    const std::string kind = GetParam();
    return of_plugin(("touchstone-threads_" + kind + ".so").c_str(),
                     "threads-" + (kind == "unforked" ? kind : "after-fork") + parameter);
  }
};

TEST_P(Threads, OfAnEngineAnswerInEverySession) {
  CandidateProcess process(member(""), 0);
  for (int session = 0; session < 3; ++session) {
    const auto answers = process.answers(std::vector<Configuration>(5, standing));
    ASSERT_EQ(answers.size(), 5u);
    for (const Answer& a : answers) {
      ASSERT_EQ(a.status, TS_CONTACT) << a.reason;
      EXPECT_EQ(a.signed_distance, -3 * standing.pose_a.position().x());
    }
  }
  ASSERT_TRUE(process.prepare_timing(std::vector<Configuration>(20, standing)));
  EXPECT_TRUE(process.cost_per_query());
}

TEST_P(Threads, ACrashIsAnsweredAndTheNextSessionRuns) {
  CandidateProcess process(member(":13"), 0);
  for (const Answer& a : process.answers(std::vector<Configuration>(2, standing))) {
    EXPECT_EQ(a.status, TS_CRASHED);
    EXPECT_THAT(a.reason, StartsWith("Aborted"));
  }
}

INSTANTIATE_TEST_SUITE_P(Plugin, Threads, testing::Values("after_fork", "unforked"),
                         [](const auto& test) { return std::string(test.param); });

TEST(PluginProcess, RefusesWhatIsNoPlugin) {
  const auto refused = [](const std::string& file, const std::string& why) {
    EXPECT_THAT([&] { add_file(file); },
                testing::ThrowsMessage<InvalidInput>(AllOf(HasSubstr("--load"), HasSubstr(why))))
        << file;
  };
  const std::string folder = TOUCHSTONE_TEST_PLUGINS;
  refused("nowhere.so", "must be a file");
  refused("/etc/passwd", "must be a plug-in, which is a shared object (.so)");
  refused(folder + "/touchstone-old.so", "version 2 of candidate.h; this is version 5");
  refused(folder + "/touchstone-deadly.so", "Aborted");
  refused(folder + "/touchstone-outside.so", "whose name is not of up to 63 characters");
  refused(folder + "/touchstone-twins.so", "must not bring \"twin\", a name that is taken");
  sabotage("sabotage");
  refused(folder + "/touchstone-sabotage.so", "a name that is taken");
}

/// A process that runs a function until it is ended.
class Child {
 public:
  explicit Child(const std::function<void()>& work) : pid_(fork()) {
    if (pid_ != 0) return;
    for (;;) work();
  }
  ~Child() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

constexpr useconds_t a_while = 300000;

TEST(Watch, SeesAProcessWait) {
  const Child child([] { pause(); });
  usleep(a_while);  // until it does
  const Watch watch(child.pid());
  usleep(a_while);
  const Watch::TimeUse spent = watch.spent();
  if (!spent.waiting) GTEST_SKIP() << "this kernel does not tell";
  EXPECT_GE(*spent.waiting, 0.9e-6 * a_while);
  EXPECT_LE(spent.computing, 0.1e-6 * a_while);
}

TEST(Watch, DoesNotTakeAProcessThatGetsNoProcessorForOneThatWaits) {
  const auto work_on_the_first_processor = [] {
    cpu_set_t first;
    CPU_ZERO(&first);
    CPU_SET(0, &first);
    sched_setaffinity(0, sizeof first, &first);
    volatile bool over = false;
    while (!over) {
    }
  };
  const Child one(work_on_the_first_processor), two(work_on_the_first_processor),
      three(work_on_the_first_processor), four(work_on_the_first_processor);
  usleep(a_while);
  const Watch watch(one.pid());
  usleep(a_while);
  const Watch::TimeUse spent = watch.spent();
  EXPECT_LT(spent.computing, 0.7 * spent.by_the_clock);
  EXPECT_LT(spent.waiting.value_or(0), 0.05 * spent.by_the_clock);
}

// Its messages may be others.
TEST(PluginHost, OfAnotherBuildIsRefused) {
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends), 0);
  const int questions = memfd_create("questions", 0), exchange = memfd_create("exchange", 0);
  ASSERT_EQ(ftruncate(questions, sizeof(Questions) + 8), 0);
  ASSERT_EQ(ftruncate(exchange, sizeof(Exchange)), 0);
  const std::string host = standard_folder() / "touchstone-host";
  const std::string parent = std::to_string(getpid());
  const pid_t pid = fork();
  if (pid == 0) {
    const int given[] = {ends[1], questions, exchange};
    int moved[3];
    for (int i = 0; i < 3; ++i) moved[i] = fcntl(given[i], F_DUPFD, 20);
    for (int i = 0; i < 3; ++i) dup2(moved[i], host_socket + i);
    execl(host.c_str(), host.c_str(), "any.so", parent.c_str(), static_cast<char*>(nullptr));
    _exit(100);
  }
  close(ends[1]);
  Reply reply{};
  EXPECT_EQ(recv(ends[0], &reply, sizeof reply, 0), static_cast<ssize_t>(sizeof reply));
  EXPECT_EQ(reply.kind, Reply::no_host);
  int status = 0;
  EXPECT_EQ(waitpid(pid, &status, 0), pid);
  EXPECT_EQ(WEXITSTATUS(status), 2);
  for (const int file : {ends[0], questions, exchange}) close(file);
}

}  // namespace

}  // namespace touchstone
