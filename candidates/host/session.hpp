#pragma once

#include <cfenv>
#include <vector>

#include "candidates/host/exchange.hpp"
#include "candidates/host/instruction_counter.hpp"

namespace touchstone {

// Messages on the candidate's side; they end the process when the harness is gone.
void send(int socket, const void* message, std::size_t size);
void report(int socket, Report::Kind kind, std::uint64_t ticket, int value, const char* text = "",
            bool left_behind = false);
Command receive(int socket);

/// One candidate in a process of its own, which obeys commands until it is told to finish, or dies.
class Session {
 public:
  Session(const ts_candidate& candidate, const Command& begin, int socket,
          const Questions& questions, Exchange& exchange);
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
  void release_all_but_of(const Command& command, std::uint32_t first);
  void warm_up();
  void query_all();  ///< that is kept for timing, once
  void time();

  const ts_candidate& candidate_;
  double threshold_, parameter_;
  int socket_;
  const Questions& asked_;
  Exchange& exchange_;
  std::fenv_t environment_;  ///< of floating-point arithmetic, as the loaded plug-in has it
  ts_answer* answer_;
  std::vector<Ready> ready_;  ///< the last pairs of shapes that were asked for, oldest first
  std::vector<Question> questions_;
  std::vector<Kept> kept_;
  std::size_t passes_ = 1;  ///< over them in one timed round
  InstructionCounter counter_;
};

}  // namespace touchstone
