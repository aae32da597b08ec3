#include "configuration.hpp"

#include <algorithm>
#include <array>

namespace touchstone {

Pair pair_of(const Configuration& configuration) {
  // In the order of Shape's alternatives.
  constexpr Pair pairs[] = {Pair::cylinder, Pair::plane, Pair::sphere,
                            Pair::capsule,  Pair::box,   Pair::convex};
  return pairs[configuration.b.index()];
}

const char* pair_name(Pair pair) {
  constexpr std::array names = {"cylinder-plane",    "cylinder-sphere", "cylinder-capsule",
                                "cylinder-cylinder", "cylinder-box",    "cylinder-convex"};
  return names[static_cast<std::size_t>(pair)];
}

double smaller_size(const Configuration& configuration) {
  return std::min(smallest_half_extent(configuration.a), smallest_half_extent(configuration.b));
}

double larger_size(const Configuration& configuration) {
  return std::max(largest_half_extent(configuration.a), largest_half_extent(configuration.b));
}

}  // namespace touchstone
