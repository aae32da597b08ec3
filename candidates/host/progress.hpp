#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace touchstone {

/// "120 of 23600 configurations, 735/s, 32 s left". The remaining time is left out until something
/// is done.
std::string progress_text(const std::string& unit, std::size_t done, std::size_t total,
                          double seconds);

/// Prints the progress of long work on standard error: on a terminal rewritten in place, otherwise
/// every ten seconds, so that short work prints nothing.
class Progress {
 public:
  /// Expects `total` units of the given name ("configurations").
  Progress(std::string unit, std::size_t total);
  /// Clears the line on a terminal.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Prints if it is time to; may be called often.
  void update(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string unit_;
  std::size_t total_;
  bool terminal_;
  Clock::time_point start_, printed_;
};

}  // namespace touchstone
