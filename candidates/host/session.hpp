#pragma once

#include <cfenv>
#include <cstdint>
#include <optional>
#include <vector>

#include "candidates/host/exchange.hpp"

namespace touchstone {

/// Counts the instructions that this process retires in user space, if machine and kernel allow it
/// (perf_event_open(2); kernel.perf_event_paranoid up to 2).
class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  void start() const;
  /// The count since start, within a few dozen; absent if instructions cannot be counted.
  std::optional<std::uint64_t> stop() const;

 private:
  int file_;  ///< -1: not permitted
};

// Messages on the candidate's side. They end the process if the harness has gone.
void send(int socket, const void* message, std::size_t size);
void reply(int socket, Reply::Kind kind, std::uint64_t ticket, int value, const char* text = "",
           bool left_behind = false);
Command receive(int socket);

/// One candidate in a process of its own, which executes commands until it is told to finish or
/// dies.
class Session {
 public:
  Session(const ts_candidate& candidate, const Command& begin, int socket,
          const Questions& questions, Exchange& exchange);
  [[noreturn]] void serve();

 private:
  /// Two prepared shapes, for one pose after another.
  struct PreparedPair {
    ts_shape a, b;
    ts_prepared* prepared;  ///< null if the pair is not supported
  };
  /// Prepared shapes and poses for timing.
  struct TimedQuery {
    ts_prepared* prepared;
    ts_pose a, b;
  };

  void obey(const Command& command);
  ts_prepared* prepare(const Question& question);
  ts_prepared* ready(const Question& question);
  void answer(std::uint32_t slot);
  void release_all_but_of(const Command& command, std::uint32_t first);
  void warm_up();
  void query_all();  ///< queries everything kept for timing once
  void time();

  const ts_candidate& candidate_;
  double threshold_, parameter_;
  int socket_;
  const Questions& asked_;
  Exchange& exchange_;
  std::fenv_t environment_;  ///< floating-point environment after loading the plug-in
  ts_answer* answer_;
  std::vector<PreparedPair> ready_;  ///< the last pairs of shapes queried, oldest first
  std::vector<Question> questions_;
  std::vector<TimedQuery> kept_;
  std::size_t passes_ = 1;  ///< passes over kept_ in one timed round
  InstructionCounter counter_;
};

}  // namespace touchstone
