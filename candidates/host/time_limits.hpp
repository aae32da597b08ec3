#pragma once

#include <string>
#include <vector>

#include "candidates/host/watch.hpp"

namespace touchstone {

/// How long a candidate may take for one configuration. Its time-outs lower the limits until the
/// next run, for a routine that never returns often does so many times; Limits::seconds of
/// candidate_process.hpp has the rule.
class TimeLimits {
 public:
  /// A limit of processor time, and what to say of one who exceeds it.
  struct Limit {
    double seconds;
    std::string exceeded;
  };

  /// `are_lowered`: by time-outs; else it is not known how long single answers take.
  TimeLimits(double seconds, bool are_lowered) : full_(seconds), are_lowered_(are_lowered) {
    forget();
  }
  void forget();
  /// Processor time of an answer, seconds; not finite: unknown.
  void learn(double seconds);
  /// An answer's verdict is that it timed out.
  void learn_timeout() { ++timeouts_; }

  Limit full() const;
  /// `latest`: seconds that answers took which are not learnt yet. `on_suspicion`: one who exceeds
  /// it is asked again alone, so that a limit is lowered before anything has timed out.
  Limit lowered(const std::vector<double>& latest, bool on_suspicion) const;
  /// Why so many configurations have waited too long since the watch began; empty if they have not.
  /// After that, the candidate may wait half as long.
  std::string waited_too_long(const Watch& watch, double configurations);

 private:
  double full_;  ///< seconds of processor time
  bool are_lowered_;
  double max_wait_;             ///< seconds
  std::vector<double> learnt_;  ///< seconds that the first answers took
  int timeouts_;
};

}  // namespace touchstone
