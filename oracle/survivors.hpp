#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "oracle/critical_direction.hpp"
#include "oracle/difference.hpp"

namespace touchstone::oracle {

/// The difference of a configuration, with the hull's own exact faces where those given are not.
Difference exact_difference(const Configuration& configuration);

/// A critical direction that may reach the signed distance, and what is known of it.
struct Survivor {
  std::unique_ptr<CriticalDirection> direction;
  std::vector<DirectionBound> bounds;
};

/// Every direction whose gap may be within `slack` (metres, >= 0) of the signed distance.
std::vector<Survivor> all_directions(const Difference& difference, double slack);

/// Bounds each at the working precision of `balls`.
void enclose(std::vector<Survivor>& survivors, const Difference& difference,
             const BallDifference& balls);

/// Lower and upper bound of the largest gap, in units, if known.
struct Maximum {
  std::optional<Float> lo, hi;
};

/// Largest lower and upper ends over all bounds. A bound without a normal counts as an upper one
/// only; one that is not finite leaves the upper end open.
Maximum maximum(const std::vector<Survivor>& survivors);

/// Drops directions all of whose bounds lie below `limit`: they are not maxima and do not tie with
/// one.
void drop_below(std::vector<Survivor>& survivors, const Float& limit);

/// Is the signed distance proven to be zero? Every gap that may reach zero must be proven not to
/// exceed it, and at least one to be zero.
bool is_exactly_zero(const std::vector<Survivor>& survivors, const Difference& difference);

}  // namespace touchstone::oracle
