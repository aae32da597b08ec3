#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace touchstone {

/// "120 of 23600 configurations, 735/s, 32 s left". What is left is not said before anything is
/// done.
std::string progress_text(const std::string& unit, std::size_t done, std::size_t total,
                          double seconds);

/// The state of work that takes long, on standard error: rewritten in place on a terminal, printed
/// every ten seconds otherwise, and not at all for work that is done before.
class Progress {
 public:
  /// `total` units of the given name ("configurations").
  Progress(std::string unit, std::size_t total);
  /// Clears the line on a terminal.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// May be called as often as one likes.
  void update(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string unit_;
  std::size_t total_;
  bool terminal_;
  Clock::time_point start_, printed_;
};

}  // namespace touchstone
