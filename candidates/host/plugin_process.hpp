#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <sys/types.h>
#include <unistd.h>
#include <vector>

#include "candidates/candidates.hpp"
#include "candidates/host/exchange.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

/// A plug-in, loaded in a process of its own: its symbols, global state and crashes affect neither
/// other plug-ins nor this process. Throws InvalidInput (field "--load") when it cannot be
/// loaded.
class PluginProcess {
 public:
  /// Time allowed for loading it, which may read libraries from a cold disk.
  static constexpr std::chrono::milliseconds loading_time = std::chrono::seconds(30);
  explicit PluginProcess(const std::filesystem::path& file,
                         std::chrono::milliseconds loading = loading_time);
  ~PluginProcess();
  PluginProcess(PluginProcess&&) noexcept;
  PluginProcess& operator=(PluginProcess&&) noexcept;

  const std::vector<Candidate>& candidates() const;

 private:
  friend class PluginSessions;
  struct State;
  std::unique_ptr<State> state_;
};

/// What loads plug-ins cannot be started: no fault of a plug-in, none of which can be asked.
struct NoHost : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// A plug-in's process and the communication with it. After any failure it is stopped, with all
/// processes that it has started, and started again for the next question.
struct PluginProcess::State {
  /// Result of waiting for a message.
  enum class Received { message, noise, nothing, end };

  std::filesystem::path file;
  std::filesystem::path host;  ///< the program that loads it
  std::vector<Candidate> candidates;
  bool unforked = false;  ///< a session is the plug-in's process itself
  /// The process that made this. A candidate that calls exit runs our destructors in its own
  /// process, where they must do nothing.
  const pid_t owner = getpid();
  pid_t guard = -1;  ///< guard of the plug-in's process (guard.hpp); -1: there is none
  int socket = -1;
  int text = -1;  ///< file with the plug-in's output
  int questions_file = -1, exchange_file = -1;
  Questions* questions = nullptr;
  Exchange* exchange = nullptr;

  State(const std::filesystem::path& file);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Loads the plug-in and reads its descriptions. Throws InvalidInput (field "--load").
  void start(std::chrono::milliseconds loading);
  bool runs() const { return guard > 0; }
  void stop();

  /// Receives one message. `sender`, unless null, is set to the process that sent it.
  Received receive(void* message, std::size_t size, std::chrono::milliseconds time,
                   pid_t* sender = nullptr) const;
  /// Waits for one reply and ignores others; absent if it does not come.
  std::optional<Reply> await(Reply::Kind kind, std::uint64_t ticket, std::chrono::milliseconds time,
                             pid_t* sender = nullptr) const;
  /// False when the other end is closed.
  bool send(const SessionCommand& command) const;
  std::string last_line() const;  ///< the last line that the candidate printed

 private:
  /// Receives one message, ignoring noise.
  bool wait_for(void* message, std::size_t size, std::chrono::milliseconds time,
                pid_t* sender = nullptr) const;
  /// Starts the program that loads the plug-in; returns its first process, which becomes a guard.
  pid_t spawn_host(int other_end) const;
  NoHost no_host(const std::string& why) const;
};

/// Throws std::system_error of errno.
[[noreturn]] void fail(const char* call);

}  // namespace touchstone
