#pragma once

#include <chrono>
#include <optional>
#include <sys/types.h>

namespace touchstone {

/// Watches what a process does with its time: compute, wait for something, or wait for nothing but
/// a processor, which on a busy machine is not its own doing.
class Watch {
 public:
  /// Both since the watch began, in seconds.
  struct Spent {
    double computing;
    /// For anything but a processor. Zero while a thread of it can run, and less than it is when
    /// several of them could; absent where the kernel does not tell.
    std::optional<double> waiting;
    double by_the_clock;
  };

  explicit Watch(pid_t process);
  Spent spent() const;

 private:
  pid_t process_;
  double computed_;
  std::optional<double> starved_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace touchstone
