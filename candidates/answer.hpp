#pragma once

#include <array>
#include <optional>
#include <string>

#include "candidates/candidate.h"

namespace touchstone {

/// A candidate's answer, or the reason why there is none.
struct Answer : ts_answer {
  /// For TS_CRASHED and TS_TIMED_OUT, and where it is known for TS_FAILED: "Segmentation fault".
  std::string reason;
  std::optional<double> model_distance;  ///< signed distance of a simplified model's shapes, metres
  /// By which radii the engine rounds A and B, metres, where that is not as they were given.
  std::optional<std::array<double, 2>> roundings = {};
  bool was_asked = true;  ///< false: the candidate had been stopped (answers_until_stopped)
};

}  // namespace touchstone
