#include "candidates/host/progress.hpp"

#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace touchstone {
namespace {

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
