#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "candidates/host/host_process.hpp"
#include "candidates/host/messages.hpp"
#include "candidates/host/respondent.hpp"
#include "candidates/host/watch.hpp"

namespace touchstone {

/// A command that runs as a child, with pipes to its standard input and output. After any failure
/// it is stopped, with all processes that it has started.
class CommandProcess : public HostProcess {
 public:
  /// What a request may use.
  struct Allowance {
    double processor_seconds, waiting_seconds, mebibytes;
  };

  /// Time for the command to start and to say hello; it may compile itself, or load a model.
  static constexpr std::chrono::seconds starting_time{30};

  /// `command` is for /bin/sh -c, run in `folder`.
  CommandProcess(std::string command, std::filesystem::path folder);
  ~CommandProcess() { stop(); }
  CommandProcess(const CommandProcess&) = delete;
  CommandProcess& operator=(const CommandProcess&) = delete;

  /// Starts it and exchanges the hellos. Throws NoAnswer.
  messages::Hello start(std::chrono::milliseconds time = starting_time);
  void stop();

  /// Sends a request and waits for the answer: a frame of `size` bytes, or a line if that is zero.
  /// Stops the process and throws NoAnswer if there is none. Precondition: it runs.
  std::string ask(const std::string& request, std::size_t size, const Allowance& allowance);
  /// Stops the process, whose answer was not what it should be; throws NoAnswer.
  [[noreturn]] void refuse(const std::string& why);
  /// Begins to measure its use of time and memory. Precondition: it runs.
  Watch watch() const { return Watch(guard_, Watch::Of::descendants_too); }

 private:
  // These stop the process and throw NoAnswer.
  [[noreturn]] void give_up(ts_status status, std::string reason);
  [[noreturn]] void ended();

  std::string command_;
  std::filesystem::path folder_;
  int input_ = -1, output_ = -1;  ///< ends of the child's pipes
  std::string received_;
};

}  // namespace touchstone
