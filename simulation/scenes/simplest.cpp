#include "simulation/scenes/simplest.hpp"

#include <algorithm>

namespace touchstone {

std::optional<std::size_t> simplest_of_cheapest(const std::vector<Finalist>& finalists,
                                                double limit) {
  for (const Finalist& f : finalists) limit = std::min(limit, f.seconds / cheaper_share);
  const Finalist* result = nullptr;
  for (const Finalist& f : finalists) {
    if (f.seconds <= limit && (!result || f.rank < result->rank)) result = &f;
  }
  return result ? std::optional(result->index) : std::nullopt;
}

}  // namespace touchstone
