// A command is asked as a plug-in is, whatever it does.
#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "candidates/candidates.hpp"
#include "candidates/host/candidate_process.hpp"
#include "candidates/host/own_respondent.hpp"
#include "candidates/host/plugin_process.hpp"
#include "oracle/hull.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double mark = 666;

std::string command(const std::string& format, const std::string& deed = "none") {
  return TOUCHSTONE_TEST_COMMAND " " + format + " '" + deed + "'";
}

/// What the command says it is, without being added to the candidates.
Candidate told(const std::string& format, const std::string& deed = "none") {
  Candidate candidate;
  candidate.name = candidate.family = "told";
  candidate.value = 2;
  candidate.supports[TS_SPHERE] = candidate.supports[TS_BOX] = candidate.supports[TS_CONVEX] = true;
  candidate.origin = Candidate::Command{command(format, deed), std::filesystem::current_path(),
                                        format == "frames"};
  return candidate;
}

/// Questions of which the given ones have the mark.
std::vector<Configuration> configurations(std::size_t count,
                                          const std::vector<std::size_t>& marked) {
  std::vector<Configuration> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 0.1 * static_cast<double>(i);
    const bool is_marked = std::find(marked.begin(), marked.end(), i) != marked.end();
    const Pose pose_b({is_marked ? mark : x, 1, 0}, Eigen::Quaterniond(1, 0, 0, 0));
    // Neighbours have one body's shape in common, or none.
    const std::size_t pair_of_neighbours = i / 2;
    const double radius_a = 0.5 + static_cast<double>(pair_of_neighbours),
                 radius_b = 0.25 + static_cast<double>(i % 3);
    result.push_back({Cylinder(radius_a, 1), Pose({x, 2, 3}, Eigen::Quaterniond(0, 1, 0, 0)),
                      Sphere(radius_b), pose_b});
  }
  return result;
}

/// The answer of testing/command.py: minus the sum of all numbers of the question.
double expected(const Configuration& c, double threshold, double parameter) {
  const ts_shape a = to_ts_shape(c.a), b = to_ts_shape(c.b);
  const ts_pose pose_a = to_ts_pose(c.pose_a), pose_b = to_ts_pose(c.pose_b);
  double sum = threshold + parameter;
  for (const auto* shape : {&a, &b}) sum += shape->size[0] + shape->size[1] + shape->size[2];
  for (const double x : coordinates_of(b)) sum += x;
  for (const auto* pose : {&pose_a, &pose_b}) {
    for (const double x : pose->position) sum += x;
    for (const double x : pose->orientation) sum += x;
  }
  return -sum;
}

void expect_true_answer(const Answer& answer, const Configuration& c) {
  ASSERT_EQ(answer.status, TS_CONTACT) << answer.reason;
  EXPECT_NEAR(answer.signed_distance, expected(c, 0.125, 2), 1e-12);
  EXPECT_EQ(answer.point_count, 1);
  EXPECT_EQ(answer.points[0].position[0], c.pose_a.position().x());
}

Limits quick() {
  Limits limits;
  limits.seconds = 0.02;
  return limits;
}

class Formats : public testing::TestWithParam<const char*> {};

TEST_P(Formats, CarryEveryNumberThereAndBack) {
  CandidateProcess process(told(GetParam()), 0.125);
  const auto asked = configurations(300, {});
  const std::vector<Answer> answers = process.answers(asked);
  ASSERT_EQ(answers.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) expect_true_answer(answers[i], asked[i]);
  expect_true_answer(process.answer(asked[7]), asked[7]);
}

TEST_P(Formats, CarryTheVerticesOfConvexBodies) {
  CandidateProcess process(told(GetParam()), 0.125);
  auto asked = configurations(6, {});
  for (const int i : {1, 2, 5}) {
    asked[i].b = oracle::convex_hull({{0.1, 0, 0}, {0, 0.2, 0}, {0, 0, 0.3}, {-1.0 * i, -1, -1}});
  }
  const std::vector<Answer> answers = process.answers(asked);
  for (std::size_t i = 0; i < asked.size(); ++i) expect_true_answer(answers[i], asked[i]);
}

TEST_P(Formats, APairWithoutARoutineIsUnsupported) {
  CandidateProcess process(told(GetParam()), 0);
  const Configuration c{Cylinder(1, 1), Pose(), Capsule(1, 1), Pose()};
  EXPECT_EQ(process.answer(c).status, TS_UNSUPPORTED);
}

TEST_P(Formats, TimesAreThoseOfTheQueries) {
  CandidateProcess process(told(GetParam()), 0);
  // The clocks are compared in each preparation, which another load of the machine can spoil.
  double our_clock = 0;
  for (int i = 0; i < 5 && our_clock <= 0.5; ++i) {
    ASSERT_TRUE(process.prepare_timing(configurations(30, {})));
    const QueryCost cost = process.cost_per_query().value();
    EXPECT_GT(cost.nanoseconds, 200);  // Python
    EXPECT_LT(cost.nanoseconds, 1e6);
    ASSERT_TRUE(cost.measured);
    EXPECT_GT(cost.measured->floor, 200);
    our_clock = cost.measured->our_clock;
  }
  EXPECT_GT(our_clock, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Command, Formats, testing::Values("frames", "lines"),
                         [](const auto& test) { return std::string(test.param); });

struct Deed {
  const char* name;
  ts_status status;
  const char* reason;
};

class Deeds : public testing::TestWithParam<std::tuple<const char*, Deed>> {};

TEST_P(Deeds, AreAnsweredForTheirConfigurationAlone) {
  const auto& [format, deed] = GetParam();
  CandidateProcess process(told(format, deed.name), 0.125, quick());
  const std::vector<std::size_t> marked = {11, 19, 20};
  const auto asked = configurations(24, marked);
  const std::vector<Answer> answers = process.answers(asked);
  ASSERT_EQ(answers.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (std::find(marked.begin(), marked.end(), i) == marked.end()) {
      expect_true_answer(answers[i], asked[i]);
      continue;
    }
    EXPECT_EQ(answers[i].status, deed.status) << answers[i].reason;
    EXPECT_THAT(answers[i].reason, HasSubstr(deed.reason));
  }
}

constexpr Deed deeds[] = {
    {"exit", TS_CRASHED, "ended with exit code 3; standard error: a word to explain it"},
    {"abort", TS_CRASHED, "Aborted"},
    {"spin", TS_TIMED_OUT, "no answer within 0.02 s"},
    {"sleep", TS_TIMED_OUT, "no answer, having waited for 0.2 s"},
    {"stall", TS_TIMED_OUT, "no answer, having waited for 0.2 s"},
    {"close", TS_CRASHED, "closed its standard output"},
    {"garbage", TS_CRASHED, "wrote what is no answer"},
    {"partial", TS_CRASHED, "ended with exit code 0"},
    {"leave", TS_CRASHED, "ended with exit code 1"},
    {"ticket", TS_CRASHED, "ticket"},
    {"count", TS_CRASHED, "wrote what is no answer"},
    {"status", TS_CRASHED, "status"},
    {"points", TS_CRASHED, "points"},
    {"type", TS_CRASHED, "wrote what is no answer"},
    {"more", TS_CRASHED, "more than its answer"}};
INSTANTIATE_TEST_SUITE_P(
    Command, Deeds, testing::Combine(testing::Values("frames", "lines"), testing::ValuesIn(deeds)),
    [](const auto& test) {
      return std::string(std::get<0>(test.param)) + "_" + std::get<1>(test.param).name;
    });

TEST(CommandProcess, MayUseSoMuchMemory) {
  Limits limits;
  limits.seconds = 20;
  limits.mebibytes = 256;
  CandidateProcess process(told("lines", "memory"), 0.125, limits);
  const auto answers = process.answers(configurations(2, {1}));
  EXPECT_EQ(answers[1].status, TS_CRASHED);
  EXPECT_EQ(answers[1].reason, "used more than 256 MiB of memory");
}

TEST(CommandProcess, LeavesNoProcessBehind) {
  {
    CandidateProcess process(told("frames", "leave"), 0.125, quick());
    process.answers(configurations(3, {1}));
  }
  std::ifstream found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::string line;
    std::getline(std::ifstream(entry.path() / "cmdline"), line);
    EXPECT_NE(line, std::string("sleep\0001234\0", 11)) << entry.path();
  }
}

TEST(CommandProcess, OneThatFailsAlwaysIsNotAskedForever) {
  CandidateProcess process(told("frames", "exit"), 0.125, quick());
  std::vector<std::size_t> all(200);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const auto answers = process.answers(configurations(200, all));
  EXPECT_EQ(answers.back().status, TS_CRASHED);
  EXPECT_THAT(answers.back().reason, HasSubstr("was not asked after failures in a row"));
  // The next call begins anew.
  const auto asked = configurations(2, {});
  expect_true_answer(process.answers(asked)[1], asked[1]);
}

TEST(CommandProcess, IsRefusedWithTheReason) {
  const auto refused_with = [](const std::string& deed, const std::string& message) {
    EXPECT_THAT([&] { add_command(command("frames", deed)); },
                ThrowsMessage<InvalidInput>(HasSubstr(message)))
        << deed;
  };
  refused_with("ends", "ended with exit code 4; standard error: no such engine");
  refused_with("chatter", "Welcome to my engine!");
  refused_with("hello {\"name\": \"a b\"}", "must be up to 63 characters");
  refused_with("hello {\"name\": \"reference\"}", "a name that is taken");
  EXPECT_THAT([] { add_command("/no/such/program"); },
              ThrowsMessage<InvalidInput>(HasSubstr("not found")));
  const Candidate silent = told("frames", "silent");
  EXPECT_THAT([&] { PluginProcess(*silent.command(), std::chrono::milliseconds(300)); },
              ThrowsMessage<InvalidInput>(HasSubstr("nothing was heard of it within 300 ms")));
}

TEST(CommandProcess, IsAddedByCommandAndByList) {
  add_command(command("lines", "hello {\"name\": \"by-command\"}"));
  const OwnFolder folder;
  add_file(folder.with(
      "list.txt", "# engines\n\n" + command("frames", "hello {\"name\": \"by-list\"}") + "\n"));
  EXPECT_EQ(find_candidate("by-command:3").value, 3);
  EXPECT_EQ(find_candidate("by-list").runs, "script");
  EXPECT_EQ(find_candidate("by-list").command()->folder, folder.path);
  EXPECT_THAT([&] { add_file(folder.with("list.txt", "# engines\ntrue\n")); },
              ThrowsMessage<InvalidInput>(HasSubstr("line 2: \"true\"")));
}

bool are_same(const ts_point& x, const ts_point& y) {
  return std::ranges::equal(x.position, y.position) && std::ranges::equal(x.normal, y.normal) &&
         x.depth == y.depth;
}

bool are_same(const Answer& x, const Answer& y) {
  if (x.status != y.status || x.point_count != y.point_count) return false;
  for (int i = 0; i < x.point_count; ++i) {
    if (!are_same(x.points[i], y.points[i])) return false;
  }
  return x.signed_distance == y.signed_distance && std::ranges::equal(x.normal, y.normal) &&
         x.model_distance == y.model_distance && x.reason == y.reason;
}

TEST(OwnRespondent, AnswersAsASessionDoes) {
  std::size_t own = 0, contacts = 0;
  for (const Candidate* candidate : all_candidates()) {
    if (!is_own(*candidate)) continue;
    ++own;
    CandidateProcess process(*candidate, 0.01), here(asked_here(*candidate), 0.01);
    for (const Pair pair : all_pairs) {
      std::vector<Configuration> asked;
      for (const char* pose_class : {"general+shallow", "touching", "general+deep"}) {
        for (std::uint64_t i = 0; i < 10; ++i) {
          asked.push_back(make_configuration({pair, pose_class, 7, i}));
        }
      }
      const auto expected = process.answers(asked), given = here.answers(asked);
      ASSERT_EQ(given.size(), expected.size());
      for (std::size_t i = 0; i < asked.size(); ++i) {
        EXPECT_TRUE(are_same(given[i], expected[i])) << candidate->name << ' ' << i;
        contacts += given[i].status == TS_CONTACT;
      }
    }
  }
  EXPECT_EQ(own, 7U);
  EXPECT_GT(contacts, 500U);
}

TEST(OwnRespondent, TakesHintsAndThresholdsAsASessionDoes) {
  const Candidate& reference = find_candidate("reference");
  CandidateProcess process(reference, 0), here(asked_here(reference), 0);
  const Vec3 up = Vec3::UnitZ(), down = -up;
  std::vector<Configuration> asked;
  std::vector<const Vec3*> hints;
  std::vector<double> thresholds;
  for (std::uint64_t i = 0; i < 30; ++i) {
    asked.push_back(make_configuration({Pair::cylinder, "parallel", 3, i}));
    hints.push_back(i % 3 == 0 ? nullptr : i % 3 == 1 ? &up : &down);
    thresholds.push_back(0.1 * static_cast<double>(i % 4));
  }
  const auto expected = process.answer(asked, hints, thresholds);
  const auto given = here.answer(asked, hints, thresholds);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_TRUE(are_same(given[i], expected[i])) << i;
  }
}

TEST(OwnRespondent, IsNotForEngines) {
  for (const char* name : {"bullet", "ode", "fcl", "mujoco", "bullet-hull:16"}) {
    EXPECT_FALSE(is_own(find_candidate(name))) << name;
  }
  Candidate added = find_candidate("reference");
  added.added = Added{"--load", "touchstone-reference.so"};
  EXPECT_FALSE(is_own(added));
}

}  // namespace
}  // namespace touchstone
