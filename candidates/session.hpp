#pragma once

#include <vector>

#include "candidates/exchange.hpp"
#include "candidates/instruction_counter.hpp"

namespace touchstone {

// Messages on the candidate's side; they end the process when the harness is gone.
void send(int socket, const void* message, std::size_t size);
void report(int socket, Report::Kind kind, int value, const char* text = "");
Command receive(int socket);

/// One candidate in a process of its own, which obeys commands until it is told to finish, or dies.
class Session {
 public:
  Session(const ts_candidate& candidate, const Command& begin, int socket, Exchange& exchange);
  [[noreturn]] void serve();

 private:
  /// Two shapes made ready, for one pose after another.
  struct Ready {
    ts_shape a, b;
    ts_prepared* prepared;  ///< null where the pair is not supported
  };
  /// Ready for timing.
  struct Kept {
    ts_prepared* prepared;
    ts_pose a, b;
  };

  void obey(const Command& command);
  ts_prepared* prepare(const Question& question);
  ts_prepared* ready(const Question& question);
  void answer(std::uint32_t slot);
  void warm_up();
  void query_all();  ///< that is kept for timing, once
  void time();

  const ts_candidate& candidate_;
  double threshold_, parameter_;
  int socket_;
  Exchange& exchange_;
  ts_answer* answer_;
  std::vector<Ready> ready_;  ///< the last pairs of shapes that were asked for, oldest first
  std::vector<Question> questions_;
  std::vector<Kept> kept_;
  std::size_t passes_ = 1;  ///< over them in one timed round
  InstructionCounter counter_;
};

}  // namespace touchstone
