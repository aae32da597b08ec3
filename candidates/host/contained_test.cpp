#include "candidates/host/contained.hpp"

#include <csignal>
#include <gtest/gtest.h>
#include <stdexcept>

namespace touchstone {
namespace {

using End = Contained::End;

TEST(Contained, GivesWhatTheTaskReturnsHoweverLong) {
  const std::string text(1 << 20, 'x');
  const Contained ran = run_contained([&] { return text; }, 10);
  EXPECT_EQ(ran.end, End::returned);
  EXPECT_EQ(ran.text, text);
}

TEST(Contained, LeavesThisProcessAsItWas) {
  int changed = 0;
  run_contained([&] { return std::to_string(++changed); }, 10);
  EXPECT_EQ(changed, 0);
}

TEST(Contained, SaysHowACrashEnded) {
  const Contained ran = run_contained(
      []() -> std::string {
        std::raise(SIGSEGV);
        return "";
      },
      10);
  EXPECT_EQ(ran.end, End::crashed);
  EXPECT_EQ(ran.text, "Segmentation fault");
}

TEST(Contained, TakesAnExceptionForACrashWithItsText) {
  const Contained ran =
      run_contained([]() -> std::string { throw std::runtime_error("no engine"); }, 10);
  EXPECT_EQ(ran.end, End::crashed);
  EXPECT_EQ(ran.text, "no engine");
}

TEST(Contained, EndsATaskThatHangs) {
  const Contained ran = run_contained(
      []() -> std::string {
        volatile int i = 0;
        for (;;) i = 1 - i;
      },
      1);
  EXPECT_EQ(ran.end, End::timed_out);
}

}  // namespace
}  // namespace touchstone
