#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <sys/types.h>

#include "candidates/candidate.h"

namespace touchstone {

// What the harness and a candidate's process say to each other: plain bytes through shared memory
// and a socket that keeps messages apart.

/// Shapes and poses of one configuration, and the hint.
struct Question {
  ts_shape a, b;
  ts_pose pose_a, pose_b;
  bool has_previous_normal;
  double previous_normal[3];
};

struct Slot {
  ts_answer answer;
  double model_distance;  ///< NaN where it is not known
  std::uint64_t seal;     ///< see seal_of
};

/// Questions and answers in one message.
inline constexpr std::uint32_t batch_size = 64;

/// Shared memory that the candidate's processes cannot write to, whatever they do.
struct Questions {
  Question slots[batch_size];
};

/// Shared memory, zero at first.
struct Exchange {
  /// Slots of this batch that are finished, and the lower half of the command's ticket above, so
  /// that it is seen when this is written over.
  std::atomic<std::uint64_t> progress;
  char thrown[240];     ///< what an uncaught exception said
  double nanoseconds;   ///< per query, of the last timed round
  double instructions;  ///< likewise; NaN where they cannot be counted
  Slot slots[batch_size];
};

inline std::uint64_t progress_of(std::uint64_t ticket, std::uint32_t done) {
  return ticket << 32 | done;
}

/// Tells the answer to a question of this command from all else that may stand in its slot: that of
/// an earlier command, or what a routine wrote over it. It is no defence against forgery: a
/// candidate may answer what it likes.
inline std::uint64_t seal_of(const Slot& slot, std::uint64_t ticket) {
  constexpr std::size_t words = offsetof(Slot, seal) / sizeof(std::uint64_t);
  std::uint64_t word[words], sum = ticket;
  std::memcpy(word, &slot, sizeof word);
  for (std::size_t i = 0; i < words; ++i) sum += (word[i] ^ ticket) * (0x9e3779b97f4a7c15u + 2 * i);
  return sum;
}

/// Told to the process that has loaded the plug-in (`begin`) and to the session that it forks.
struct Command {
  enum Kind : std::uint32_t {
    begin,    ///< fork a session for the candidate `index` with `threshold` and `parameter`
    answer,   ///< answer slots first … count − 1
    keep,     ///< keep the questions of slots 0 … count − 1 for timing
    warm_up,  ///< prepare and query them once, as many as fit into the time of one round
    time,     ///< one timed round
    finish    ///< end the session
  };
  Kind kind;
  std::uint32_t first, count;
  std::uint64_t ticket;  ///< no two commands have the same
  bool release;          ///< `answer`: keep no shapes ready for later commands
  std::int32_t index;
  double threshold, parameter;
  std::uint64_t memory;  ///< bytes that a session may grow by
};

/// What comes back. Anything else that comes is noise, as from a routine that writes to descriptors
/// that are not its own.
struct Report {
  enum Kind : std::uint32_t {
    described,  ///< of the plug-in: `value` candidates; a Description of each follows
    refused,    ///< of the plug-in: it cannot be used; `text` says why
    began,      ///< said by the session itself; `value` is negative where none could be made
    finished,   ///< the session has done what it was told
    ended,      ///< the session is over, with the wait status `value`
    gone        ///< the process that has loaded the plug-in is, with the wait status `value`
  };
  Kind kind;
  std::int32_t value;
  std::uint64_t ticket;  ///< of the command that it answers; of `ended`, the one that began it
  bool left_behind;      ///< `ended`: processes that the session started still run
  char text[240];
};

/// A ts_candidate without its pointers. Longer texts are cut.
struct Description {
  char name[64], version[64], settings[1024], models[512], meaning[256];
  double least, most, usual;
  bool has_parameter, whole, bare;
  bool supports[5];
};

/// Exit code of a session that an exception left.
inline constexpr int exit_thrown = 97;

/// What runs in the process of a plug-in: loads it, describes it on the socket, then serves
/// sessions until the other end is closed.
[[noreturn]] void serve_plugin(const char* file, int socket, const Questions& questions,
                               Exchange& exchange);

}  // namespace touchstone
