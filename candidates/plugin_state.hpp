#pragma once

#include <string>
#include <sys/types.h>
#include <unistd.h>
#include <vector>

#include "candidates/candidate_process.hpp"
#include "candidates/exchange.hpp"

namespace touchstone {

/// A plug-in's process and what goes to and from it.
struct PluginProcess::State {
  std::vector<Candidate> candidates;
  /// A candidate that calls exit runs our destructors in its own process: they must do nothing
  /// there.
  const pid_t owner = getpid();
  pid_t pid = -1;
  int socket = -1;
  int text = -1;  ///< what the plug-in prints
  Exchange* exchange = nullptr;

  ~State();
  /// False when the other end is closed or nothing came in time; -1 waits for ever.
  bool receive(void* message, std::size_t size, int milliseconds) const;
  /// Throws std::runtime_error when the process has ended.
  Report receive() const;
  void send(const Command& command) const;
  std::string last_line() const;  ///< that the candidate printed
};

/// Text of a plug-in as it may stand in a report: what is no UTF-8 (a text that was cut may end in
/// the middle of a character) becomes "?", control characters become spaces.
std::string readable(const std::string& text);
/// "Segmentation fault", "ended with exit code 3".
std::string how_it_ended(int wait_status);
/// Throws std::system_error of errno.
[[noreturn]] void fail(const char* call);

}  // namespace touchstone
