#include "candidates/host/interruption.hpp"

#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "candidates/host/worker_processes.hpp"

namespace touchstone {
namespace {

TEST(Interruption, AsksOnceAndIsForgotten) {
  EXPECT_FALSE(interrupted());
  for (const int signal : {SIGINT, SIGTERM}) {
    const Interruption interruption;
    EXPECT_FALSE(interrupted());
    testing::internal::CaptureStderr();
    raise(signal);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("once more"));
    EXPECT_TRUE(interrupted());
    EXPECT_EQ(interrupting_signal(), signal);
    EXPECT_EQ(interrupted_exit_code(), signal == SIGINT ? 130 : 143);
  }
  EXPECT_FALSE(interrupted());
}

TEST(InterruptionDeathTest, ASecondSignalEndsAtOnce) {
  const auto twice = [] {
    const Interruption interruption;
    raise(SIGINT);
    raise(SIGTERM);
  };
  EXPECT_EXIT(twice(), testing::KilledBySignal(SIGTERM), "once more");
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
      [](std::size_t i) {
        while (i == 2) sleep(1000);  // would never end
        return std::string("done");
      },
      [](std::size_t) { return std::string(); },
      [](std::size_t done) {
        if (done == 2) raise(SIGINT);
      });
  testing::internal::GetCapturedStderr();
  EXPECT_THAT(results, testing::ElementsAre("done", "done", ""));
}

}  // namespace
}  // namespace touchstone
