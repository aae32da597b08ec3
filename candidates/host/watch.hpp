#pragma once

#include <chrono>
#include <optional>
#include <sys/types.h>

namespace touchstone {

/// Seconds of processor time that a process has used; zero if it has ended.
double processor_seconds(pid_t process);

/// Measures how a process spends its time: computing, waiting for something, or waiting for a
/// processor, which on a busy machine is not its own fault.
class Watch {
 public:
  /// Seconds since the watch began.
  struct TimeUse {
    double computing;
    /// Waiting for anything but a processor. Zero while one of its threads can run, and
    /// underestimated if several could; absent if the kernel does not tell.
    std::optional<double> waiting;
    double by_the_clock;
  };

  explicit Watch(pid_t process);
  TimeUse spent() const;

 private:
  pid_t process_;
  double computed_;
  std::optional<double> starved_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace touchstone
