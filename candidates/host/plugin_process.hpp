#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <sys/types.h>
#include <vector>

#include "candidates/candidates.hpp"
#include "candidates/host/exchange.hpp"
#include "candidates/host/host_process.hpp"

namespace touchstone {

/// A plug-in, loaded in a process of its own: its symbols, global state and crashes affect neither
/// other plug-ins nor this process. After any failure it is stopped, and started again for the next
/// question.
class PluginProcess : public HostProcess {
 public:
  /// Time allowed for loading it, which may read libraries from a cold disk.
  static constexpr std::chrono::milliseconds loading_time = std::chrono::seconds(30);
  /// Loads it. Throws InvalidInput (field "--load") when it cannot be loaded.
  explicit PluginProcess(const std::filesystem::path& file,
                         std::chrono::milliseconds loading = loading_time);
  ~PluginProcess();
  PluginProcess(const PluginProcess&) = delete;
  PluginProcess& operator=(const PluginProcess&) = delete;

  const std::vector<Candidate>& candidates() const { return candidates_; }
  /// A session is the plug-in's process itself.
  bool is_unforked() const { return is_unforked_; }
  Questions& questions() const { return *questions_; }
  Exchange& exchange() const { return *exchange_; }

  /// Loads the plug-in and reads its descriptions. Throws as the constructor does.
  void start(std::chrono::milliseconds loading = loading_time);

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
  /// Receives one message, ignoring noise.
  bool wait_for(void* message, std::size_t size, std::chrono::milliseconds time,
                pid_t* sender = nullptr) const;
  void release_memory();

  std::filesystem::path file_;
  std::vector<Candidate> candidates_;
  bool is_unforked_ = false;
  int questions_file_ = -1, exchange_file_ = -1;
  Questions* questions_ = nullptr;
  Exchange* exchange_ = nullptr;
};

}  // namespace touchstone
