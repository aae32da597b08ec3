#include "configuration.hpp"

#include <algorithm>

namespace touchstone {

Pair pair_of(const Configuration& configuration) {
  // In the order of Shape's alternatives.
  constexpr Pair pairs[] = {Pair::cylinder, Pair::plane, Pair::sphere, Pair::capsule, Pair::box};
  return pairs[configuration.b.index()];
}

const char* pair_name(Pair pair) {
  switch (pair) {
    case Pair::plane:
      return "cylinder-plane";
    case Pair::sphere:
      return "cylinder-sphere";
    case Pair::capsule:
      return "cylinder-capsule";
    case Pair::cylinder:
      return "cylinder-cylinder";
    case Pair::box:
      return "cylinder-box";
  }
  return "";
}

double smaller_size(const Configuration& configuration) {
  return std::min(smallest_half_extent(configuration.a), smallest_half_extent(configuration.b));
}

double larger_size(const Configuration& configuration) {
  return std::max(largest_half_extent(configuration.a), largest_half_extent(configuration.b));
}

}  // namespace touchstone
