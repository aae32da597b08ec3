#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <sys/types.h>

#include "candidates/answer.hpp"
#include "candidates/ts_shape.hpp"

namespace touchstone {

// The messages between the harness and a candidate's process: plain bytes in shared memory and on a
// socket that preserves message boundaries.

/// Pairs of shapes kept prepared for the next poses of the same bodies, as in a world: more than
/// most scenes have, few enough for the largest meshes.
inline constexpr std::size_t max_ready = 8;

/// Shapes and poses of one configuration, up to which distance contacts are wanted, and the hint.
struct Question {
  ts_shape a, b;
  ts_pose pose_a, pose_b;
  double threshold;
  bool has_previous_normal;
  double previous_normal[3];
};

/// What a candidate says of its model of a pair (Answer). NaN: nothing.
struct Modelled {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double distance = unknown;
  double roundings[2] = {unknown, unknown};

  void copy_to(Answer& answer) const {
    if (!std::isnan(distance)) answer.model_distance = distance;
    const bool is_known = !std::isnan(roundings[0]) && !std::isnan(roundings[1]);
    if (is_known) answer.roundings = {roundings[0], roundings[1]};
  }
};

struct Slot {
  ts_answer answer;
  Modelled modelled;
  double seconds;      ///< processor time of preparing, querying and releasing
  std::uint64_t seal;  ///< see seal_of
};

/// Number of questions and answers in one batch.
inline constexpr std::uint32_t batch_size = 64;

/// The rule for a candidate's name, which command lines, lists and files hold; in words, after
/// "must be".
constexpr bool is_candidate_name(std::string_view name) {
  constexpr std::size_t max_length = 63;
  if (name.empty() || name.size() > max_length || name.front() == '-') return false;
  for (const char c : name) {
    if (c <= ' ' || c > '~' || c == ':' || c == ',' || c == '/') return false;
  }
  return true;
}
inline constexpr const char* candidate_names =
    "up to 63 characters of printable ASCII without colon, comma, slash or space, not beginning "
    "with a hyphen";

/// What a convex body's pointers lead to, which in another process lead nowhere.
struct Hull {
  static constexpr std::size_t max_vertices = 4096;
  double coordinates[3 * max_vertices];
  /// V vertices have at most 3 V edges, each in two faces, and 2 V faces.
  int face_list[8 * max_vertices];
};

/// Shared memory that the candidate's processes cannot write to. What is never written takes none.
struct Questions {
  Question slots[batch_size];
  Hull hulls[batch_size];  ///< the slots' bodies B, where they are convex

  void put(std::size_t i, const Question& question) {
    slots[i] = question;
    std::ranges::copy(coordinates_of(question.b), hulls[i].coordinates);
    std::ranges::copy(face_list_of(question.b), hulls[i].face_list);
  }
  /// Its pointers lead into this.
  Question get(std::size_t i) const {
    Question question = slots[i];
    if (question.b.kind != TS_CONVEX) return question;
    question.b.vertices = hulls[i].coordinates;
    question.b.faces = hulls[i].face_list;
    return question;
  }
};

/// Shared memory, zero at first.
struct Exchange {
  /// Number of finished slots of this batch, or of steps; the upper half is the lower half of the
  /// command's ticket, which reveals overwriting.
  std::atomic<std::uint64_t> progress;
  char text[1000];          ///< what an uncaught exception said, or why there is no candidate
  double nanoseconds;       ///< per query, in the last timed round
  double queries;           ///< in that round
  double instructions;      ///< per query; NaN if they cannot be counted
  double tail_nanoseconds;  ///< 95th percentile over the queries of each one's least time so far
  double floor;             ///< of a command: nanoseconds of a query of the shapes far apart
  Slot slots[batch_size];
};

inline std::uint64_t progress_of(std::uint64_t ticket, std::uint32_t done) {
  return ticket << 32 | done;
}

/// Checksum that distinguishes the answer to a question of this command from other content of its
/// slot: the answer to an earlier command, or overwritten bytes. It does not protect against
/// forgery; a candidate may answer what it likes.
inline std::uint64_t seal_of(const Slot& slot, std::uint64_t ticket) {
  constexpr std::size_t words = offsetof(Slot, seal) / sizeof(std::uint64_t);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&slot);
  std::uint64_t sum = ticket;
  for (std::size_t i = 0; i < words; ++i) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i * sizeof word, sizeof word);
    sum += (word ^ ticket) * (0x9e3779b97f4a7c15u + 2 * i);
  }
  return sum;
}

/// Sent to the process that has loaded the plug-in (`begin`) and to the session that it forks.
struct SessionCommand {
  enum Kind : std::uint32_t {
    begin,    ///< fork a session for the candidate `index` with `parameter`
    answer,   ///< answer slots 0 … count − 1
    keep,     ///< keep the questions of slots 0 … count − 1 for timing
    warm_up,  ///< prepare and query once as many of them as fit into the time of one round
    time,     ///< one timed round; of a command, `count` times as long
    finish    ///< end the session
  };
  Kind kind;
  std::uint32_t count;
  std::uint64_t ticket;  ///< unique to the command
  bool release;  ///< `answer`: keep no shapes ready for later commands; `keep`: none kept before
  bool forget;   ///< `answer`: at first, release the shapes kept ready for it
  std::int32_t processor;  ///< `keep`: the only one to run on from now on; -1: as before
  std::int32_t index;
  double parameter;
  std::uint64_t memory;  ///< growth in bytes that a session is allowed
  bool warm;             ///< `begin`: a command is first asked an easy question
};

/// A message to the harness. Everything else on the socket is noise, as from a routine that writes
/// to foreign descriptors.
struct Reply {
  enum Kind : std::uint32_t {
    described,  ///< the plug-in has `value` candidates; a Description of each follows
    refused,    ///< the plug-in cannot be used; Exchange::text says why
    no_host,    ///< what loads plug-ins is of another build
    began,      ///< sent by the session itself; `value` is negative if none could be forked
    finished,   ///< the session has done its command
    ended,      ///< the session has ended with the wait status `value`
    gone        ///< the process that has loaded the plug-in has ended with the wait status `value`
  };
  Kind kind;
  std::int32_t value;
  std::uint64_t ticket;  ///< ticket of the command; for `ended`, of the one that began the session
  bool left_behind;      ///< for `ended`: processes that the session started are still running
};

/// A candidate without pointers. Longer texts are truncated.
struct Description {
  char name[64], version[256], settings[4096], models[1024], meaning[256];
  double min, max, usual;
  bool has_parameter, whole, bare;
  bool supports[shape_kinds];
  bool unforked;
  // Of a command; empty and false of a plug-in.
  char precision[8], runs[8];
  bool in_frames;
  bool says_roundings;  ///< takes rounded bodies, and says how it rounds them
  bool has_casts;
};

/// A text that may lack its end.
template <std::size_t size>
std::string text_of(const char (&text)[size]) {
  return std::string(text, strnlen(text, size));
}

template <std::size_t size>
void copy_text(const char* from, char (&to)[size]) {
  std::snprintf(to, size, "%s", from ? from : "");
}

/// Exit code of a session that ended by an exception.
inline constexpr int exit_thrown = 97;

// Messages on the candidate's side. They end the process if the harness has gone.
void send(int socket, const void* message, std::size_t size);
void reply(int socket, Reply::Kind kind, std::uint64_t ticket, int value, bool left_behind = false);
SessionCommand receive(int socket);

class SpokenCommand;

/// ts_plugin::roundings
using Roundings = decltype(ts_plugin::roundings);

/// One candidate's session in this process: executes commands until it is told to finish or dies.
/// `spoken` is what answers if that is a command, which measures its time itself; else null.
[[noreturn]] void serve_session(const ts_candidate& candidate, Roundings roundings,
                                SpokenCommand* spoken, const SessionCommand& begin, int socket,
                                const Questions& questions, Exchange& exchange);

/// Descriptors of a plug-in's process besides the standard three, when it is started: its end of
/// the socket, and the shared memory.
inline constexpr int host_socket = 3, host_questions = 4, host_exchange = 5;
/// Environment variable by which the dynamic linker resolves all symbols at the start (ld.so(8)).
/// Otherwise every session would do so again.
inline constexpr const char* bind_now = "LD_BIND_NOW";

/// Main function of a plug-in's process: loads the plug-in, or where there is a folder starts the
/// command in it, describes it on the socket, then serves sessions until the other end is closed.
[[noreturn]] void serve_plugin(const char* file, const char* folder, int socket,
                               const Questions& questions, Exchange& exchange);

}  // namespace touchstone
