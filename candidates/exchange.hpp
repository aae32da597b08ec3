#pragma once

#include <atomic>
#include <cstdint>
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
  Question question;
  ts_answer answer;
  double model_distance;  ///< NaN where it is not known
};

/// Shared memory, zero at first.
struct Exchange {
  static constexpr std::uint32_t batch = 64;
  std::atomic<std::uint32_t> done;  ///< slots of this batch that are finished
  char thrown[240];                 ///< what an uncaught exception said
  double nanoseconds;               ///< per query, of the last timed round
  double instructions;              ///< likewise; NaN where they cannot be counted
  Slot slots[batch];
};

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
  std::int32_t index;
  double threshold, parameter;
  std::uint64_t memory;  ///< bytes that a session may grow by
};

/// What comes back.
struct Report {
  enum Kind : std::uint32_t {
    described,  ///< of the plug-in: `value` candidates; a Description of each follows
    refused,    ///< of the plug-in: it cannot be used; `text` says why
    began,      ///< a session runs in the process `value`
    finished,   ///< the session has done what it was told
    ended       ///< the session is over, with the wait status `value`
  };
  Kind kind;
  std::int32_t value;
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
[[noreturn]] void serve_plugin(const char* file, int socket, Exchange& exchange);

}  // namespace touchstone
