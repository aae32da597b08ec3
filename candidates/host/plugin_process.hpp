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
#include "candidates/host/host_process.hpp"

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

/// A plug-in's process and the communication with it. After any failure it is stopped, with all
/// processes that it has started, and started again for the next question.
struct PluginProcess::State : HostProcess {
  /// Result of waiting for a message.
  enum class Received { message, noise, nothing, end };

  std::filesystem::path file;
  std::vector<Candidate> candidates;
  bool unforked = false;  ///< a session is the plug-in's process itself
  int questions_file = -1, exchange_file = -1;
  Questions* questions = nullptr;
  Exchange* exchange = nullptr;

  State(const std::filesystem::path& file);
  ~State();

  /// Loads the plug-in and reads its descriptions. Throws InvalidInput (field "--load").
  void start(std::chrono::milliseconds loading);

  /// Receives one message. `sender`, unless null, is set to the process that sent it.
  Received receive(void* message, std::size_t size, std::chrono::milliseconds time,
                   pid_t* sender = nullptr) const;
  /// Waits for one reply and ignores others; absent if it does not come.
  std::optional<Reply> await(Reply::Kind kind, std::uint64_t ticket, std::chrono::milliseconds time,
                             pid_t* sender = nullptr) const;
  /// False when the other end is closed.
  bool send(const SessionCommand& command) const;

 private:
  /// Receives one message, ignoring noise.
  bool wait_for(void* message, std::size_t size, std::chrono::milliseconds time,
                pid_t* sender = nullptr) const;
};

}  // namespace touchstone
