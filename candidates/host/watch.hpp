#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>

namespace touchstone {

enum class Watched { process, descendants_too };

/// Seconds of processor time that a process has used, or it and its descendants, of those that have
/// not ended.
double processor_seconds(pid_t process, Watched watched = Watched::process);

/// Measures how a process, or it and its descendants, spend their time: computing, waiting for
/// something, or waiting for a processor, which on a busy machine is not their own fault.
class Watch {
 public:
  /// Seconds since the watch began.
  struct TimeUse {
    double computing;
    /// Waiting for anything but a processor. Zero while one of the threads can run, and
    /// underestimated if several could; absent if the kernel does not tell.
    std::optional<double> waiting;
    double by_the_clock;
  };

  explicit Watch(pid_t process, Watched watched = Watched::process);
  TimeUse spent() const;
  double resident_mebibytes() const;  ///< memory in use now

 private:
  pid_t process_;
  Watched watched_;
  double computed_;
  std::optional<double> starved_;
  std::chrono::steady_clock::time_point start_;
};

/// "0.05 s", of a limit.
std::string seconds_text(double seconds);

}  // namespace touchstone
