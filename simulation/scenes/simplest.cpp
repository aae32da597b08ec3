#include "simulation/scenes/simplest.hpp"

#include <algorithm>
#include <tuple>

namespace touchstone {

std::vector<std::size_t> finalists(std::vector<Finalist> promising) {
  constexpr std::size_t max_count = 6;
  if (promising.empty()) return {};
  const Finalist cheapest = *std::ranges::min_element(promising, {}, &Finalist::seconds);
  const double limit = cheapest.seconds / (cheaper_share * cheaper_share);
  std::erase_if(promising, [&](const Finalist& f) { return f.seconds > limit; });
  std::ranges::sort(promising, {}, [&](const Finalist& f) {
    return std::tuple(f.index != cheapest.index, f.rank, f.index);
  });
  std::vector<std::size_t> result;
  for (const Finalist& f : promising) {
    if (result.size() < max_count) result.push_back(f.index);
  }
  return result;
}

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
