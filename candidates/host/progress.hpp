#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace touchstone {

/// "120 of 23600 configurations, 735/s, 32 s left". The remaining time is left out until something
/// is done.
std::string progress_text(const std::string& unit, std::size_t done, std::size_t total,
                          double seconds);

/// "[=====>              ] 27%, 1 min 5 s left: 120 of 23600 configurations". The remaining time is
/// left out until a hundredth is done.
std::string overall_text(double share, double seconds, const std::string& part);

/// Long work of which each part has its Progress. As standard error is one, so is this: while it
/// lives, those print one line that tells of the whole.
class OverallProgress {
 public:
  struct Part {
    std::string unit;  ///< of its Progress
    double share;      ///< of all the time, about; any positive numbers do
  };
  /// The parts in their order; one that does not come counts as done when a later one begins.
  explicit OverallProgress(std::vector<Part> parts);
  ~OverallProgress();
  OverallProgress(const OverallProgress&) = delete;
  OverallProgress& operator=(const OverallProgress&) = delete;

 private:
  friend class Progress;
  /// What is printed when of the part with this unit `done` of `total` are done.
  std::string text(const std::string& unit, std::size_t done, std::size_t total) const;

  std::vector<Part> parts_;
  std::chrono::steady_clock::time_point start_;
};

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
