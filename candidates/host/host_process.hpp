#pragma once

#include <string>
#include <sys/types.h>
#include <unistd.h>
#include <vector>

#include "reference/invalid_input.hpp"

namespace touchstone {

/// What runs candidates cannot be started: no fault of a candidate, none of which can be asked.
struct NoHost : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// A process of the program touchstone-host, in which what may fail runs: behind a guard
/// (guard.hpp), which ends all that it starts, and without descriptors of ours.
class HostProcess {
 public:
  HostProcess();
  ~HostProcess();
  HostProcess(const HostProcess&) = delete;
  HostProcess& operator=(const HostProcess&) = delete;

  bool runs() const { return guard_ > 0; }
  /// Ends it, with all processes that it has started.
  void stop();
  /// The last line that it printed.
  std::string last_line() const;
  void clear_text() const;

 protected:
  /// Starts the program, whose arguments come before our process's id. It gets these files as its
  /// descriptors from standard input on, and among them, as host_socket, an end of the socket.
  void start_host(std::vector<std::string> arguments, std::vector<int> files);
  static NoHost no_host(const std::string& why);

  /// The process that made this. A candidate that calls exit runs our destructors in its own
  /// process, where they must do nothing.
  const pid_t owner_ = getpid();
  pid_t guard_ = -1;  ///< its first process, which guards the others; -1: there is none
  int socket_ = -1;
  int text_ = -1;  ///< file in memory with what it prints
};

/// Throws std::system_error of errno.
[[noreturn]] void fail(const char* call);

}  // namespace touchstone
