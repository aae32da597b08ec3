#include "candidates/host/watch.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace touchstone {
namespace {

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

}  // namespace
}  // namespace touchstone
