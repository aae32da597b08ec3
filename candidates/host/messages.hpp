#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "candidates/answer.hpp"
#include "candidates/candidates.hpp"
#include "candidates/host/exchange.hpp"

namespace touchstone::messages {

// The messages between Touchstone and a candidate that is a command, to the byte as
// docs/process-candidates.md specifies them. Pure functions of their arguments.

/// How all messages after the hello are written.
enum class Format { frames, lines };

enum class Operation : std::uint32_t { prepare = 1, query = 2, time = 3, release = 4 };

/// What makes a text no answer to a request: "its ticket is 7 instead of 8".
struct Garbage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A piece of a message in quotes, for people: printable, and short.
std::string quoted(const std::string& text);

/// What the child says of itself.
struct Hello {
  Candidate candidate;  ///< without command
  Format format;
};

/// The line, without its end, with which Touchstone begins.
std::string hello();
/// Reads the child's line. Throws Garbage that names the member, its value and the remedy.
Hello read_hello(const std::string& line);

/// Shapes to be prepared under a handle.
struct PairOfShapes {
  std::uint32_t handle;
  double threshold, parameter;
  ts_shape a, b;
};

/// Poses, and the hint, of shapes that were prepared under a handle.
struct Poses {
  std::uint32_t handle;
  ts_pose a, b;
  bool has_previous_normal;
  double previous_normal[3];
};

/// The whole request, with its length or the line's end.
std::string prepare_request(Format format, std::uint64_t ticket,
                            std::span<const PairOfShapes> pairs);
std::string query_request(Format format, std::uint64_t ticket, std::span<const Poses> poses);
std::string time_request(Format format, std::uint64_t ticket, std::uint32_t passes,
                         std::span<const Poses> poses);
std::string release_request(Format format, std::uint64_t ticket,
                            std::span<const std::uint32_t> handles);

/// The number of bytes of an answer in frames to `count` entries, with its length.
std::size_t frame_size(Operation operation, std::uint32_t count);

// Readers of answers: of a whole frame, or a line without its end. Throw Garbage.

/// Which of the pairs are supported.
std::vector<bool> read_prepared(Format format, std::uint64_t ticket, std::uint32_t count,
                                const std::string& text);
std::vector<Answer> read_answers(Format format, std::uint64_t ticket, std::uint32_t count,
                                 const std::string& text);
/// Nanoseconds of all passes: finite and not negative.
double read_time(Format format, std::uint64_t ticket, std::uint32_t count, const std::string& text);
void read_released(Format format, std::uint64_t ticket, std::uint32_t count,
                   const std::string& text);

}  // namespace touchstone::messages
