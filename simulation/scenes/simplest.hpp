#pragma once

#include <cstddef>
#include <optional>
#include <vector>

// Which of several choices that all serve is the answer: noise of the machine must not decide.

namespace touchstone {

/// Share of another's time below which a candidate or a run counts as cheaper: smaller differences
/// are noise of the machine, and the simpler one is preferred.
inline constexpr double cheaper_share = 0.9;

/// What may be the answer.
struct Finalist {
  std::size_t index;  ///< of a run or setting
  double seconds;
  std::size_t rank;  ///< 0 is the simplest
};

/// Indices of the runs or settings that may prove to be the answer once they are timed together: of
/// these the one that now seems the cheapest first, then the simplest that may cost much the same.
/// Twice the noise apart, for what is within a tenth by its times must not be left out by an
/// estimate; six at most.
std::vector<std::size_t> finalists(std::vector<Finalist> promising);

/// Index of the simplest finalist of those that take at most `limit` seconds and much the same as
/// the cheapest; of equally simple ones the first. Absent where all take longer than the limit.
std::optional<std::size_t> simplest_of_cheapest(const std::vector<Finalist>& finalists,
                                                double limit);

}  // namespace touchstone
