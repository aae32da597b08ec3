#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace touchstone {

/// One line on standard error for work that takes long: done, rate, time left. Rewritten in place
/// on a terminal, otherwise printed every ten seconds.
class Progress {
 public:
  /// `total` units of the given name ("configurations").
  Progress(std::string unit, std::size_t total);
  /// Ends the line on a terminal.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string unit_;
  std::size_t total_;
  bool terminal_;
  Clock::time_point start_, printed_;
};

}  // namespace touchstone
