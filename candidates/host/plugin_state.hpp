#pragma once

#include <string>
#include <sys/types.h>
#include <unistd.h>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "candidates/host/exchange.hpp"

namespace touchstone {

/// A plug-in's process and what goes to and from it. Once anything is wrong with it, it is stopped
/// with all that it has started, and started again for the next question.
struct PluginProcess::State {
  /// What waiting for a message came to.
  enum class Received { message, noise, nothing, end };

  std::filesystem::path file;
  std::vector<Candidate> candidates;
  /// A candidate that calls exit runs our destructors in its own process: they must do nothing
  /// there.
  const pid_t owner = getpid();
  pid_t guard = -1;  ///< of the plug-in's process (guard.hpp); -1: there is none
  int socket = -1;
  int text = -1;  ///< what the plug-in prints
  int questions_file = -1, exchange_file = -1;
  Questions* questions = nullptr;
  Exchange* exchange = nullptr;

  State(const std::filesystem::path& file);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Loads the plug-in and has it described. Throws InvalidInput (field "--candidate").
  void start(std::chrono::milliseconds loading);
  bool runs() const { return guard > 0; }
  void stop();

  /// `sender`, unless null, is the process that sent the message, as this one knows it.
  Received receive(void* message, std::size_t size, std::chrono::milliseconds time,
                   pid_t* sender = nullptr) const;
  /// False when the other end is closed.
  bool send(const Command& command) const;
  std::string last_line() const;  ///< that the candidate printed

 private:
  /// The same, passing over noise.
  bool wait_for(void* message, std::size_t size, std::chrono::milliseconds time) const;
  [[noreturn]] void serve(int other_end) const;
};

/// Text of a plug-in as it may stand in a report: what is no UTF-8 (a text that was cut may end in
/// the middle of a character) becomes "?", control characters become spaces.
std::string readable(const std::string& text);
/// "Segmentation fault", "ended with exit code 3".
std::string how_it_ended(int wait_status);
/// Throws std::system_error of errno.
[[noreturn]] void fail(const char* call);

}  // namespace touchstone
