#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reference/configuration.hpp"

namespace touchstone {

/// A slow continuous motion of A through a degenerate pose. With an even number of steps the
/// degenerate pose itself is one of them.
struct Motion {
  std::string name;         ///< "roll-over-edge"
  std::string description;  ///< one sentence
  /// At a time from -1 to 1; a rational function, so that the same time gives the same bits
  /// everywhere.
  std::function<Configuration(double time)> at;
};

/// In report order.
const std::vector<Motion>& motions();
/// Throws InvalidInput that names those there are.
const Motion& find_motion(std::string_view name);

/// The pose after `step` of `steps` equal steps of time. Precondition: 0 <= step <= steps, 0 <
/// steps.
Configuration pose_at(const Motion& motion, int step, int steps);

}  // namespace touchstone
