#include "candidates/host/worker_processes.hpp"

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <initializer_list>
#include <pty.h>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "candidates/host/contained.hpp"
#include "candidates/host/interruption.hpp"
#include "candidates/host/progress.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

/// A shell's jobs in the background ignore Ctrl-C, and what nohup starts a hangup; so would what is
/// interrupted here.
[[maybe_unused]] const auto heard_here = {signal(SIGINT, SIG_DFL), signal(SIGTERM, SIG_DFL),
                                          signal(SIGHUP, SIG_DFL)};

std::string name(std::size_t i) { return "task " + std::to_string(i); }
void ignore(std::size_t) {}

/// Calls f(first byte, end) for the memory that this process shares with others.
template <class F>
void each_shared_mapping(F f) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    void *from = nullptr, *to = nullptr;
    char rights[5] = "";
    if (std::sscanf(line.c_str(), "%p-%p %4s", &from, &to, rights) == 3 &&
        std::string(rights) == "rw-s") {
      f(static_cast<char*>(from), static_cast<char*>(to));
    }
  }
}

bool is_running(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/stat");
  std::string number, program, state;
  return file >> number >> program >> state && state != "Z";
}

/// Waits for this thread's children to end, however slow the machine is; what they wrote is in
/// their pipes then.
void await_the_end_of_all_workers() {
  const auto is_any_running = [] {
    std::ifstream children("/proc/thread-self/children");
    for (std::string pid; children >> pid;) {
      if (is_running(pid)) return true;
    }
    return false;
  };
  while (is_any_running()) usleep(1000);
}

TEST(WorkerProcesses, ReturnResultsInOrderWhateverTheirNumber) {
  const auto square = [](std::size_t i) {
    return std::string(i * 1000, 'x') + std::to_string(i * i);
  };
  const auto alone = run_in_processes(30, 1, square, name, ignore);
  ASSERT_EQ(alone.size(), 30u);
  EXPECT_EQ(alone[7].substr(7000), "49");
  EXPECT_EQ(run_in_processes(30, 4, square, name, ignore), alone);
  EXPECT_EQ(run_in_processes(30, 64, square, name, ignore), alone);
  EXPECT_TRUE(run_in_processes(0, 2, square, name, ignore).empty());
}

TEST(WorkerProcesses, ReportProgress) {
  std::size_t last = 0;
  run_in_processes(
      5, 2, [](std::size_t) { return std::string(); }, name,
      [&](std::size_t done) { last = done; });
  EXPECT_EQ(last, 5u);
}

TEST(WorkerProcesses, AnExceptionNamesItsTask) {
  const auto bad = [](std::size_t i) -> std::string {
    if (i == 3) throw std::runtime_error("no truth");
    return "";
  };
  EXPECT_THAT([&] { run_in_processes(6, 2, bad, name, ignore); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("task 3: no truth")));
}

TEST(WorkerProcesses, ADeadWorkerNamesItsTaskAndSignal) {
  const auto deadly = [](std::size_t i) -> std::string {
    if (i == 2) raise(SIGKILL);
    return "";
  };
  EXPECT_THAT([&] { run_in_processes(6, 2, deadly, name, ignore); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::AllOf(HasSubstr("task 2"), HasSubstr("Killed"))));
}

TEST(WorkerProcesses, AFailureLosesNothingThatOthersHaveFinished) {
  constexpr unsigned count = 8;
  const auto first_fails = [](std::uint64_t i) -> std::string {
    if (i == 0) throw std::runtime_error("no truth");
    return "done";
  };
  std::size_t taken = 0;
  const auto run = [&] {
    stream_from_processes(
        count, count, first_fails, name, [&](std::uint64_t, const std::string&) { ++taken; },
        [] {
          await_the_end_of_all_workers();
          return true;
        });
  };
  EXPECT_THAT(run, testing::ThrowsMessage<std::runtime_error>(HasSubstr("task 0: no truth")));
  EXPECT_EQ(taken, count - 1);
}

TEST(WorkerProcesses, ASecondFailureLosesNothingBehindIt) {
  constexpr std::uint64_t failing = 3;
  const auto first_fail = [](std::uint64_t i) -> std::string {
    if (i < failing) throw std::runtime_error("no truth");
    return "done";
  };
  std::vector<std::uint64_t> taken;
  const auto run = [&] {
    stream_from_processes(
        5, 1, first_fail, name, [&](std::uint64_t i, const std::string&) { taken.push_back(i); },
        [] {
          await_the_end_of_all_workers();
          return true;
        });
  };
  EXPECT_THAT(run, testing::ThrowsMessage<std::runtime_error>(HasSubstr("task 0: no truth")));
  EXPECT_THAT(taken, testing::ElementsAre(3, 4));
}

TEST(WorkerProcesses, AnEarlyEndLosesNothingThatIsFinished) {
  std::size_t taken = 0;
  const bool all = stream_from_processes(
      4, 2, [](std::uint64_t) { return std::string("done"); }, name,
      [&](std::uint64_t, const std::string&) { ++taken; },
      [] {
        await_the_end_of_all_workers();
        return false;
      });
  EXPECT_FALSE(all);
  EXPECT_EQ(taken, 4U);
}

TEST(WorkerProcesses, ATaskThatIsLostEndsTheRun) {
  // As if the worker were killed between taking a task and noting that it has: the note, behind the
  // number of the next task, is wiped.
  const auto lost = [](std::size_t i) -> std::string {
    if (i == 2) {
      each_shared_mapping([](char* from, char* to) {
        from += sizeof(std::uint64_t);
        std::memset(from, 0, static_cast<std::size_t>(to - from));
      });
      raise(SIGKILL);
    }
    return "";
  };
  EXPECT_THAT([&] { run_in_processes(6, 2, lost, name, ignore); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("5 of 6")));
}

TEST(WorkerProcesses, EndEarlyWithoutTheTasksInHand) {
  std::size_t taken = 0;
  const bool all = stream_from_processes(
      1000, 2, [](std::uint64_t) { return std::string(100, 'x'); }, name,
      [&](std::uint64_t, const std::string&) { ++taken; }, [&] { return taken < 3; });
  EXPECT_FALSE(all);
  EXPECT_GE(taken, 3u);

  const auto endless = [](std::uint64_t) -> std::string {
    for (;;) pause();
  };
  int asked = 0;
  EXPECT_FALSE(stream_from_processes(
      2, 2, endless, name, [](std::uint64_t, const std::string&) {}, [&] { return ++asked < 3; }));
}

TEST(WorkerProcesses, ShareNothingWithTheirOwnChildren) {
  // A plug-in that overwrote the number of the next task once made tasks run twice.
  const auto overwrite = [](std::size_t) -> std::string {
    const pid_t child = fork();
    if (child > 0) return std::to_string(waitpid(child, nullptr, 0) == child);
    each_shared_mapping(
        [](char* from, char* to) { std::memset(from, 0, static_cast<std::size_t>(to - from)); });
    _exit(0);
  };
  std::size_t last = 0;
  run_in_processes(6, 2, overwrite, name, [&](std::size_t done) { last = done; });
  EXPECT_EQ(last, 6u);
}

TEST(WorkerProcesses, DoNotObeyWhatIsMeantForTheirParent) {
  const auto hit = [](std::size_t) -> std::string {
    raise(SIGINT);
    raise(SIGTERM);
    raise(SIGHUP);
    return "alive";
  };
  EXPECT_EQ(run_in_processes(1, 1, hit, name, ignore).front(), "alive");
}

TEST(Interruption, AsksOnceAndIsForgotten) {
  EXPECT_FALSE(interrupted());
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Interruption interruption;
    EXPECT_FALSE(interrupted());
    testing::internal::CaptureStderr();
    raise(signal);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("once more"));
    EXPECT_TRUE(interrupted());
    EXPECT_EQ(interrupting_signal(), signal);
    EXPECT_EQ(interrupted_exit_code(), 128 + signal);
  }
  EXPECT_FALSE(interrupted());
}

/// Ends this process as long work does, unless the signals end it before.
[[noreturn]] void work_through(std::initializer_list<int> signals, useconds_t between = 0) {
  const Interruption interruption;
  for (const int signal : signals) {
    raise(signal);
    usleep(between);
  }
  _exit(interrupted_exit_code());
}

TEST(InterruptionDeathTest, ASecondSignalEndsAtOnce) {
  EXPECT_EXIT(work_through({SIGINT, SIGTERM}), testing::KilledBySignal(SIGTERM), "once more");
}

TEST(InterruptionDeathTest, TheSameSignalAtOnceIsTheSameRequest) {
  const char* const told = "ending with what there is";
  EXPECT_EXIT(work_through({SIGINT, SIGINT}), testing::ExitedWithCode(130), told);
  EXPECT_EXIT(work_through({SIGTERM, SIGHUP}), testing::ExitedWithCode(143), told);
  EXPECT_EXIT(work_through({SIGINT, SIGINT}, 350000), testing::KilledBySignal(SIGINT), "once more");
}

TEST(InterruptionDeathTest, SaysThatItEndsWhereNothingCatchesIt) {
  const auto ended = [] {
    say_when_interrupted();
    raise(SIGTERM);
  };
  EXPECT_EXIT(ended(), testing::KilledBySignal(SIGTERM), "interrupted; only what was written");
}

TEST(InterruptionDeathTest, LeavesWhatWasIgnored) {
  const auto ignored = [] {
    signal(SIGINT, SIG_IGN);
    const Interruption interruption;
    raise(SIGINT);
    _exit(interrupted() ? 1 : 0);
  };
  EXPECT_EXIT(ignored(), testing::ExitedWithCode(0), "");
}

TEST(Interruption, WorkersKeepWhatIsDone) {
  const Interruption interruption;
  testing::internal::CaptureStderr();
  const auto results = run_in_processes(
      3, 1,
      [](std::size_t i) -> std::string {
        if (i < 2) return "done";
        for (;;) pause();
      },
      [](std::size_t) { return std::string(); },
      [](std::size_t done) {
        if (done == 2) raise(SIGINT);
      });
  testing::internal::GetCapturedStderr();
  EXPECT_THAT(results, testing::ElementsAre("done", "done", ""));
}

// A task in a process of its own

using End = Contained::End;

TEST(Contained, GivesWhatTheTaskReturnsHoweverLong) {
  const std::string text(1 << 20, 'x');
  const Contained ran = run_contained([&] { return std::string(text); }, 10);
  EXPECT_EQ(ran.end, End::returned);
  EXPECT_EQ(ran.text, text);
}

TEST(Contained, LeavesThisProcessAsItWas) {
  int changed = 0;
  run_contained([&] { return std::to_string(++changed); }, 10);
  EXPECT_EQ(changed, 0);
}

TEST(Contained, SaysHowATaskEnded) {
  const struct {
    std::function<std::string()> task;
    End end;
    const char* text;
  } cases[] = {
      {[] { return std::raise(SIGSEGV), ""; }, End::crashed, "Segmentation fault"},
      {[]() -> std::string { throw std::runtime_error("no engine"); }, End::crashed, "no engine"},
      {[] { return _exit(3), ""; }, End::crashed, "ended with exit code 3"},
      {[]() -> std::string {
         volatile int i = 0;
         for (;;) i = 1 - i;
       },
       End::timed_out, "took too long"},
      {[] { return pause(), ""; }, End::timed_out, "took too long"}};
  for (const auto& [task, end, text] : cases) {
    const Contained ran = run_contained(task, 1);
    EXPECT_EQ(ran.end, end) << text;
    EXPECT_EQ(ran.text, text);
  }
}

TEST(Progress, HasRateAndTimeLeft) {
  EXPECT_EQ(progress_text("configurations", 100, 1000, 2),
            "100 of 1000 configurations, 50/s, 18 s left");
  EXPECT_EQ(progress_text("cells", 3, 303, 2), "3 of 303 cells, 1.5/s, 3 min 20 s left");
  EXPECT_EQ(progress_text("cells", 1, 10000, 2), "1 of 10000 cells, 0.5/s, 5 h 33 min left");
  EXPECT_EQ(progress_text("cells", 10, 10, 2), "10 of 10 cells, 5.0/s, 0 s left");
}

TEST(Progress, PromisesNothingBeforeAnythingIsDone) {
  EXPECT_EQ(progress_text("cells", 0, 10, 2), "0 of 10 cells");
  EXPECT_EQ(progress_text("cells", 0, 0, 0), "0 of 0 cells");
}

/// What work writes to a terminal of that many columns.
std::string on_terminal(unsigned short columns, const std::function<void()>& work) {
  winsize size{24, columns, 0, 0};
  int terminal = -1;
  const pid_t pid = forkpty(&terminal, nullptr, nullptr, &size);
  if (pid == 0) {
    work();
    _exit(0);
  }
  std::string text;
  char part[256];
  for (ssize_t got; (got = read(terminal, part, sizeof part)) > 0;) text.append(part, got);
  waitpid(pid, nullptr, 0);
  close(terminal);
  return text;
}

TEST(Progress, OfTheWholeHasABarAndTheTimeLeft) {
  EXPECT_EQ(overall_text(0.25, 30, "1 of 4 cells"),
            "[=====>              ] 25%, 1 min 30 s left: 1 of 4 cells");
  EXPECT_EQ(overall_text(0, 30, "0 of 4 cells"), "[>                   ] 0%: 0 of 4 cells");
  EXPECT_EQ(overall_text(1, 30, "4 of 4 cells"),
            "[====================] 100%, 0 s left: 4 of 4 cells");
}

void progress_for_half_a_second() {
  Progress progress("configurations", 100);
  for (std::size_t i = 0; i < 50; ++i) {
    progress.update(i);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

TEST(Progress, RewritesOneLineOnATerminalAndClearsIt) {
  const std::string text = on_terminal(80, progress_for_half_a_second);
  EXPECT_THAT(text, testing::HasSubstr(" of 100 configurations, "));
  EXPECT_THAT(text, testing::HasSubstr(" s left"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("\n")));
  EXPECT_THAT(text, testing::EndsWith("\r\x1b[K"));
}

TEST(Progress, KeepsToTheWidthOfTheTerminal) {
  EXPECT_THAT(on_terminal(20, progress_for_half_a_second),
              testing::Not(testing::HasSubstr("configurations,")));
}

TEST(Progress, OfAPartTellsOfTheWhole) {
  const auto shown = [](const char* unit) {
    return on_terminal(80, [unit] {
      const OverallProgress overall({{"cells", 3}, {"maps", 1}, {"runs", 4}});
      Progress progress(unit, 2);
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      progress.update(1);
    });
  };
  // What comes before counts as done, what comes after as not.
  EXPECT_THAT(shown("cells"), testing::ContainsRegex("\\] 18%, [0-9]+ s left: 1 of 2 cells"));
  EXPECT_THAT(shown("maps"), testing::ContainsRegex("\\] 43%, [0-9]+ s left: 1 of 2 maps"));
  EXPECT_THAT(shown("runs"), testing::ContainsRegex("\\] 75%, [0-9]+ s left: 1 of 2 runs"));
}

TEST(Progress, OfShortWorkIsSilentElsewhere) {
  testing::internal::CaptureStderr();
  {
    Progress progress("configurations", 2);
    progress.update(1);
    progress.update(2);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace touchstone
