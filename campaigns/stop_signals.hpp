#pragma once

namespace touchstone {

/// As long as one lives, SIGINT (Ctrl-C) and SIGTERM do not end the program but are kept, so that
/// it can end in order. One at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// The last one that came, or zero.
  int caught() const;
};

}  // namespace touchstone
