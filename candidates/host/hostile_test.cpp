// Whatever a plug-in does, on purpose or not: the configuration concerned gets the status that
// describes what happened, the others get their answers, no process is left running, and it does
// not take long.
#include "candidates/testing/hostile.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <set>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include "candidates/candidates.hpp"
#include "candidates/host/candidate_process.hpp"
#include "candidates/host/exchange.hpp"
#include "candidates/host/guard.hpp"
#include "candidates/host/plugin_process.hpp"
#include "reference/invalid_input.hpp"

static void PrintTo(const HostileDeed& deed, std::ostream* out) { *out << deed.name; }

namespace touchstone {
namespace {

using testing::HasSubstr;

const std::filesystem::path hostile_file = TOUCHSTONE_TEST_PLUGINS "/touchstone-hostile.so";

constexpr int culprit = 5, number = 12;

/// A limit that is to be exceeded is short; one that is not leaves time even to a slow machine, of
/// which 40 MiB of output or the 2,048 page faults of a stack of 8 MiB take a lot.
Limits limits_of(const HostileDeed& deed) {
  if (deed.reason == std::string("waited")) return {0.02, 256};
  return {(deed.ends & HostileDeed::timed_out) != 0 ? 0.05 : 5, 256};
}

/// The plug-in's own list, in which a deed's number is its place, from one.
const std::vector<HostileDeed>& all_deeds() {
  static const auto deeds = [] {
    std::vector<HostileDeed> result;
    void* const library = dlopen(hostile_file.c_str(), RTLD_NOW | RTLD_LOCAL);
    const auto deed = reinterpret_cast<const HostileDeed* (*)(int)>(dlsym(library, "hostile_deed"));
    for (int i = 0; deed(i); ++i) result.push_back(*deed(i));
    return result;
  }();
  return deeds;
}

Candidate hostile(const std::string& deed) {
  Candidate candidate = PluginProcess(hostile_file).candidates().front();
  const auto at = std::ranges::find(all_deeds(), deed, &HostileDeed::name);
  candidate.value = static_cast<double>(at - all_deeds().begin() + 1);
  return candidate;
}

std::vector<Configuration> configurations() {
  std::vector<Configuration> result;
  for (int i = 0; i < number; ++i) {
    const Pose pose({0.25 * i, 0, 1.9}, Eigen::Quaterniond::Identity());
    result.push_back({Cylinder(i == culprit ? 7 : 0.5 + i, 1), pose, Plane({0, 0, 1}, 0), Pose()});
  }
  return result;
}

void expect_right(const Answer& answer, int i) {
  EXPECT_EQ(answer.status, TS_CONTACT) << i << ": " << answer.reason;
  EXPECT_EQ(answer.signed_distance, -1.0 / 3 - 0.25 * i) << i;
  EXPECT_EQ(answer.point_count, 1) << i;
}

/// The children of this process, including orphans once it is a subreaper.
std::set<std::string> children() {
  std::set<std::string> result;
  std::ifstream list("/proc/thread-self/children");
  for (std::string pid; list >> pid;) result.insert(pid);
  return result;
}

/// Reaps children that have ended, and waits for those that are about to, two minutes at most.
void expect_children(const std::set<std::string>& expected) {
  for (int i = 0; i < 12000 && children() != expected; ++i) {
    usleep(10000);
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
  }
  EXPECT_EQ(children(), expected);
}

/// Makes a name that googletest accepts.
std::string deed_name(const std::string& deed) {
  std::string name;
  for (const char c : deed) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
    if (c == ' ' || c == '_') name += '_';
  }
  return name;
}

/// With TOUCHSTONE_TEST_NO_NAMESPACES in the environment no process gets a namespace, as in most
/// containers.
class NoNamespaces : public testing::Environment {
  void SetUp() override {
    if (!std::getenv("TOUCHSTONE_TEST_NO_NAMESPACES")) return;
    sock_filter filter[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_unshare, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog program{std::size(filter), filter};
    ASSERT_EQ(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), 0);
    ASSERT_EQ(prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program), 0);
    ASSERT_NE(unshare(CLONE_NEWPID), 0);
  }
};
const auto* const no_namespaces = testing::AddGlobalTestEnvironment(new NoNamespaces);

bool namespaces_are_given() {
  const pid_t child = fork();
  if (child == 0) _exit(begin_pid_namespace() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  return status == 0;
}

class Hostile : public testing::TestWithParam<HostileDeed> {};

TEST_P(Hostile, CostsItsOwnConfigurationAlone) {
  const HostileDeed& expected = GetParam();
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // whatever is left behind comes here
  const auto before = children();
  {
    CandidateProcess process(hostile(expected.name), 0, limits_of(expected));
    const auto asked = configurations();
    const std::vector<Answer> answers = process.answers(asked);
    ASSERT_EQ(answers.size(), asked.size());
    for (int i = 0; i < number; ++i) {
      if (i != culprit) expect_right(answers[i], i);
    }
    EXPECT_TRUE(expected.ends >> answers[culprit].status & 1)
        << answers[culprit].status << ' ' << answers[culprit].reason;
    EXPECT_THAT(answers[culprit].reason, HasSubstr(expected.reason));
    // The next questions find no trace of it.
    const std::vector<Answer> again = process.answers({asked.data(), culprit});
    for (int i = 0; i < culprit; ++i) expect_right(again[i], i);
  }
  expect_children(before);
}

INSTANTIATE_TEST_SUITE_P(Deeds, Hostile, testing::ValuesIn(all_deeds()),
                         [](const auto& tested) { return deed_name(tested.param.name); });

struct Loading {
  const char* deed;
  const char* refused;      ///< why; null: it serves
  bool hits_guard = false;  ///< where that is not out of reach; then it may be either
};

void PrintTo(const Loading& loading, std::ostream* out) { *out << loading.deed; }

class HostileLoading : public testing::TestWithParam<Loading> {};

TEST_P(HostileLoading, IsRefusedOrServes) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const auto before = children();
  const auto [deed, refused, hits_guard] = GetParam();
  const Candidate candidate = hostile("nothing");
  setenv("TOUCHSTONE_HOSTILE_LOAD", deed, 1);
  constexpr Limits limits{5, 256};
  // Only silence is waited for until the time is over.
  const bool is_silent = refused && std::string(refused) == "nothing was heard";
  const auto loading = is_silent ? std::chrono::milliseconds(1000) : PluginProcess::loading_time;
  if (hits_guard && !namespaces_are_given()) {
    try {
      CandidateProcess(candidate, 0, limits).answers(configurations());
    } catch (const InvalidInput&) {
    }
  } else if (refused) {
    EXPECT_THAT([&] { PluginProcess(hostile_file, loading); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr(refused)));
  } else {
    CandidateProcess process(candidate, 0, limits);
    for (int round = 0; round < 2; ++round) {
      const auto answers = process.answers(configurations());
      for (int i = 0; i < number; ++i) expect_right(answers[i], i);
      if (std::string(deed) == "timer") usleep(300000);  // until it has gone off
    }
  }
  unsetenv("TOUCHSTONE_HOSTILE_LOAD");
  expect_children(before);
}

INSTANTIATE_TEST_SUITE_P(
    Deeds, HostileLoading,
    testing::Values(
        Loading{"crash", "Segmentation fault"}, Loading{"abort", "Aborted"},
        Loading{"exit", "exit code 0"}, Loading{"throw", "threw"},
        Loading{"pause", "nothing was heard"}, Loading{"loop", "nothing was heard"},
        Loading{"fork, both pause", "nothing was heard"}, Loading{"stop", "after loading"},
        Loading{"close all descriptors", "after loading"},
        Loading{"kill the group", "after loading"}, Loading{"wrong version", "version 77"},
        Loading{"no candidates", "no candidates"},
        Loading{"a billion candidates", "1000000000 candidates"},
        Loading{"minus one candidate", "no candidates"}, Loading{"no name", "name"},
        Loading{"endless name", ""}, Loading{"endless settings", "Segmentation fault"},
        Loading{"no query", "leaves something out"}, Loading{"no release", "leaves something out"},
        Loading{"supports hangs", "nothing was heard"}, Loading{"daemon", nullptr},
        Loading{"write to all descriptors", nullptr},

        Loading{"kill the parent", nullptr, true}, Loading{"handle all signals", nullptr},
        Loading{"timer", nullptr}, Loading{"thread", nullptr}, Loading{"print 40 MiB", nullptr}),
    [](const auto& tested) { return deed_name(tested.param.deed); });

TEST(PluginProcess, RefusesWhatIsNoRegularFile) {
  const std::string fifo = testing::TempDir() + "touchstone-fifo-" + std::to_string(getpid());
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const std::string& file : {fifo, std::string("/dev/zero"), testing::TempDir()}) {
    EXPECT_THAT([&] { add_file(file); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("must be a regular file")))
        << file;
  }
  std::filesystem::remove(fifo);
}

TEST(CandidateProcess, AHabitualSleeperCostsLittle) {
  CandidateProcess process(hostile("sleep"), 0, {0.02, 256});
  const std::vector<Configuration> many(100, configurations()[culprit]);
  const auto start = std::chrono::steady_clock::now();
  for (const Answer& a : process.answers(many)) EXPECT_EQ(a.status, TS_TIMED_OUT);
  // 0.2 + 0.1 + 0.05 + 0.025 + 96 · 0.02 s of waiting, checked every 0.02 s. Without halving it
  // would be 100 s, twice, which leaves a slow machine a minute and a half.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(90));
}

}  // namespace
}  // namespace touchstone
