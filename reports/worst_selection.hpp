#pragma once

#include <cstdint>
#include <vector>

#include "oracle/judge/score.hpp"

namespace touchstone {

/// The score of one candidate on one configuration.
struct Case {
  std::size_t cell;     ///< Pair × class, in report order.
  std::uint64_t index;  ///< Of the configuration in its class.
  Score score;

  /// Failures first, those without an answer at the top, by severity; equal ones in report order.
  bool operator<(const Case& other) const;
};

/// Of one class the two worst cases and the worst of each outcome, worst first. Cases that a
/// candidate does not support are left out. The worst of two sets together are the worst of the
/// worst of each.
std::vector<Case> worst_of_class(std::vector<Case> cases);

/// Of what worst_of_class gave of all classes of a pair: the worst of each outcome, and what else
/// is worst up to four, worst first.
std::vector<Case> worst_of_pair(std::vector<Case> cases);

}  // namespace touchstone
