#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <unistd.h>
#include <vector>

#include "candidates/candidates.hpp"
#include "candidates/host/exchange.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

/// What runs candidates cannot be started: no fault of a candidate, none of which can be asked.
struct NoHost : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// A process of the program touchstone-host that has loaded a plug-in: its symbols, global state
/// and crashes affect neither other plug-ins nor this process. It stands behind a guard
/// (guard.hpp), which ends all that it starts, and has no descriptors of ours. A command is the one
/// candidate of a plug-in that is never forked.
class PluginProcess {
 public:
  /// Time allowed for loading it, which may read libraries from a cold disk; a command may compile
  /// itself, or load a model.
  static constexpr std::chrono::milliseconds loading_time = std::chrono::seconds(30);
  /// Loads it. Throws InvalidInput (field "--load" or "--candidate-command") when it cannot be
  /// loaded.
  explicit PluginProcess(const std::filesystem::path& file,
                         std::chrono::milliseconds loading = loading_time);
  explicit PluginProcess(const Candidate::Command& command,
                         std::chrono::milliseconds loading = loading_time);
  ~PluginProcess();
  PluginProcess(const PluginProcess&) = delete;
  PluginProcess& operator=(const PluginProcess&) = delete;

  const std::vector<Candidate>& candidates() const { return candidates_; }
  /// A session is the plug-in's process itself.
  bool is_unforked() const { return is_unforked_; }
  Questions& questions() const { return *questions_; }
  Exchange& exchange() const { return *exchange_; }

  bool runs() const { return guard_ > 0; }
  /// Ends it, with all processes that it has started.
  void stop();
  /// The last line that it printed.
  std::string last_line() const;
  void clear_text() const;

  /// Result of waiting for a message.
  enum class Received { message, noise, nothing, end };
  /// Receives one message. `sender`, unless null, is set to the process that sent it.
  Received receive(void* message, std::size_t size, std::chrono::milliseconds time,
                   pid_t* sender = nullptr) const;
  /// Waits for one reply and ignores others; absent if it does not come.
  std::optional<Reply> await(Reply::Kind kind, std::uint64_t ticket, std::chrono::milliseconds time,
                             pid_t* sender = nullptr) const;
  /// False when the other end is closed.
  bool send(const SessionCommand& command) const;

 private:
  /// Starts nothing.
  PluginProcess();
  /// Starts the program, whose arguments come before our process's id.
  void start_host(std::vector<std::string> arguments);
  /// Waits for its candidates. Returns why it cannot be used; empty if they are described.
  std::string describe(std::chrono::milliseconds loading);
  /// Receives one message, ignoring noise.
  bool wait_for(void* message, std::size_t size, std::chrono::milliseconds time,
                pid_t* sender = nullptr) const;

  /// The process that made this. A candidate that calls exit runs our destructors in its own
  /// process, where they must do nothing.
  const pid_t owner_ = getpid();
  pid_t guard_ = -1;  ///< its first process, which guards the others; -1: there is none
  int socket_ = -1;
  int text_, questions_file_, exchange_file_;  ///< in memory; the first is what it prints
  std::vector<Candidate> candidates_;
  bool is_unforked_ = false;
  Questions* questions_;
  Exchange* exchange_;
};

}  // namespace touchstone
