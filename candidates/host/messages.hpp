#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "candidates/answer.hpp"
#include "candidates/cast.h"
#include "candidates/host/exchange.hpp"

namespace touchstone::messages {

// The messages between Touchstone and a candidate that is a command, to the byte as
// candidates/host/protocol.md specifies them. Pure functions of their arguments.

/// How all messages after the hello are written.
enum class Format { frames, lines };

enum class Operation : std::uint32_t { prepare = 1, query = 2, time = 3, release = 4, cast = 5 };

/// A text that is no answer to a request: "its ticket is 7 instead of 8".
struct Garbage : std::runtime_error {
  explicit Garbage(const std::string& why)
      : std::runtime_error("wrote what is no answer: " + why) {}
};

/// A piece of a message in quotes, for people: printable, and short.
std::string quoted(const std::string& text);

/// The line, without its end, with which Touchstone begins.
std::string hello();
/// Reads the child's line, in which it describes itself. Throws Garbage that names the member, its
/// value and the remedy.
Description read_hello(const std::string& line);

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

/// A request, with its length or the line's end in its text.
struct Request {
  Format format;
  Operation operation;
  std::uint64_t ticket;
  std::uint32_t count;  ///< of entries
  std::string text;
  bool has_roundings = false;  ///< of `prepare`, by a command that says them

  /// Bytes of its answer, with their length; 0: it is a line.
  std::size_t answer_size() const;
};
Request prepare_request(Format format, std::uint64_t ticket, const PairOfShapes& pair,
                        bool has_roundings = false);
/// Of `query`, or of `time` with so many passes.
Request query_request(Format format, std::uint64_t ticket, std::span<const Poses> poses,
                      std::uint32_t passes = 0);
/// Of `cast`: the sweep stands where the hint does in a query.
Request cast_request(Format format, std::uint64_t ticket, const Poses& poses);
Request release_request(Format format, std::uint64_t ticket,
                        std::span<const std::uint32_t> handles);

// Readers of the answer to a request: a whole frame, or a line without its end. Throw Garbage.

/// A pair that is supported, with the radii by which A and B are rounded; zero if they are not
/// said.
struct Prepared {
  double roundings[2];
};
/// None if the pair is not supported.
std::optional<Prepared> read_prepared(const Request& request, const std::string& answer);
/// Of a query of one entry.
Answer read_answer(const Request& request, const std::string& answer);
/// None if the question failed.
std::optional<ts_cast> read_cast(const Request& request, const std::string& answer);
/// Nanoseconds of all passes: finite and not negative.
double read_time(const Request& request, const std::string& answer);
void read_released(const Request& request, const std::string& answer);

}  // namespace touchstone::messages
