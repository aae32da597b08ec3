#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <sys/types.h>
#include <vector>

#include "candidates/host/exchange.hpp"
#include "candidates/host/messages.hpp"

namespace touchstone {

/// A command (candidates/host/protocol.md), which runs as a child of this process, with pipes to
/// its standard input and output, and is asked as a plug-in is. Where it does not answer as it
/// should, functions throw what ends the session: std::runtime_error that says why, for people.
/// Nothing here is limited in time or memory, which the harness watches.
class SpokenCommand {
 public:
  /// What it may write to one file, its standard error included.
  static constexpr unsigned long max_file = 1ul << 28;

  /// Starts the command, which is for /bin/sh -c, in the folder, and exchanges the hellos.
  SpokenCommand(const char* line, const char* folder);
  SpokenCommand(const SpokenCommand&) = delete;
  SpokenCommand& operator=(const SpokenCommand&) = delete;

  /// As it describes itself.
  const Description& description() const { return description_; }
  /// Valid as long as this is.
  ts_candidate candidate();
  /// Null if the command says none.
  Roundings roundings() const;
  /// The answer to a cast; none if the question failed. Precondition: the description has casts.
  std::optional<ts_cast> cast(const ts_shape& a, const ts_shape& b, double parameter,
                              const messages::Poses& poses);
  /// Asks an easy question, so that what begins late begins now.
  void warm_up(double parameter);

  /// Prepares as many of these questions as take half a millisecond, by its own clock, at least
  /// ten, and asks them until their times agree. Calls step() before every request, each of which
  /// may take as long as the limits say.
  void prepare_timing(std::span<const Question> questions, double parameter,
                      const std::function<void()>& step);
  /// One round, or so many at once, of at least two milliseconds by its own clock.
  void time(std::uint32_t rounds, Exchange& exchange);

 private:
  [[noreturn]] void run(const char* line, const char* folder) const;
  /// Sends a request and waits for the answer: a frame of `size` bytes, or a line if that is zero.
  std::string ask(const std::string& request, std::size_t size);
  std::string ask(const messages::Request& request);
  [[noreturn]] void ended(bool within_message) const;

  /// Null where the pair is not supported.
  ts_prepared* prepare(const ts_shape& a, const ts_shape& b, double threshold, double parameter);
  Answer query(const messages::Poses& poses);
  void release(std::uint32_t handle);
  /// Nanoseconds of all passes.
  double time(std::span<const messages::Poses> poses, std::uint32_t passes);
  /// Nanoseconds a query once rounds agree.
  double warm_cost(std::span<const messages::Poses> poses, const std::function<void()>& step);

  pid_t child_;
  int input_, output_;  ///< ends of the child's pipes
  int end_;             ///< readable once the child has ended
  Description description_;
  bool has_spoken_ = false;  ///< said what it is
  messages::Format format_ = messages::Format::lines;
  std::uint64_t ticket_ = 0;
  std::uint32_t next_handle_ = 0;
  std::vector<std::uint32_t> released_;  ///< which the child has not been told yet
  std::vector<messages::Poses> timed_;
  std::uint32_t passes_ = 1;  ///< of one timed round
  double floor_ = 0;          ///< nanoseconds of a query of the shapes far apart
};

}  // namespace touchstone
