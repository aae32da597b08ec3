#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace touchstone {

/// Seconds of processor time that a process has used; zero if it has ended.
double processor_seconds(pid_t process);

/// Measures how a process, or it and its descendants, spend their time: computing, waiting for
/// something, or waiting for a processor, which on a busy machine is not their own fault.
class Watch {
 public:
  enum class Of { process, descendants_too };

  /// Seconds since the watch began.
  struct TimeUse {
    double computing;
    /// Waiting for anything but a processor. Zero while one of the threads can run, and
    /// underestimated if several could; absent if the kernel does not tell.
    std::optional<double> waiting;
    double by_the_clock;
  };

  explicit Watch(pid_t process, Of of = Of::process);
  TimeUse spent() const;
  double resident_mebibytes() const;  ///< memory in use now

 private:
  std::vector<pid_t> watched() const;

  pid_t process_;
  Of of_;
  double computed_;
  std::optional<double> starved_;
  std::chrono::steady_clock::time_point start_;
};

/// "0.05 s", of a limit.
std::string seconds_text(double seconds);

}  // namespace touchstone
