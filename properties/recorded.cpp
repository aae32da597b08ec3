#include "properties/recorded.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "properties/arrangement.hpp"
#include "properties/numbers.hpp"

namespace touchstone {
namespace {

struct Row {
  Pair pair;
  const char* scene;
  std::uint64_t weight;
  double numbers[20];  ///< in the order of every_number; a plane has the largest number of them
};

/// Frozen, as known failures are: identities draw from them by weight.
const Row rows[] = {
#include "recorded_rows.inc"
};

std::vector<Recorded> recorded_of(Pair pair) {
  std::vector<Recorded> result;
  for (const Row& row : rows) {
    if (row.pair != pair) continue;
    Numbers numbers;
    numbers.pair = pair;
    numbers.sizes.resize(size_count(pair));
    const double* number = row.numbers;
    for (double* each : every_number(numbers)) *each = *number++;
    result.push_back({row.scene, row.weight, configuration_of(numbers)});
  }
  return result;
}

std::uint64_t total_weight(const std::vector<Recorded>& all) {
  return std::accumulate(all.begin(), all.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Recorded& r) { return sum + r.weight; });
}

}  // namespace

const std::vector<Recorded>& recorded(Pair pair) {
  static const auto all = [] {
    std::array<std::vector<Recorded>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) result[static_cast<std::size_t>(p)] = recorded_of(p);
    return result;
  }();
  return all[static_cast<std::size_t>(pair)];
}

std::vector<RecordedShare> recorded_shares() {
  std::vector<RecordedShare> result;
  for (const Pair pair : all_pairs) {
    std::map<std::pair<std::string_view, std::optional<int>>, std::uint64_t> weights;
    for (const Recorded& r : recorded(pair)) {
      const NearestArrangement nearest = nearest_arrangement(r.configuration);
      weights[{nearest.name, nearest.tilt}] += r.weight;
    }
    const double total = static_cast<double>(total_weight(recorded(pair)));
    const auto first = static_cast<std::ptrdiff_t>(result.size());
    for (const auto& [key, weight] : weights) {
      result.push_back({pair, {key.first, key.second}, static_cast<double>(weight) / total});
    }
    std::stable_sort(
        result.begin() + first, result.end(),
        [](const RecordedShare& x, const RecordedShare& y) { return x.share > y.share; });
  }
  return result;
}

std::optional<Arrangement> recorded_arrangement(Pair pair) {
  if (recorded(pair).empty()) return std::nullopt;
  const auto generate = [&all = recorded(pair), total = total_weight(recorded(pair))](
                            Draw& draw, const Modifiers&) {
    auto left = static_cast<std::uint64_t>(draw.integer(0, static_cast<std::int64_t>(total) - 1));
    for (const Recorded& r : all) {
      if (left < r.weight) return r.configuration;
      left -= r.weight;
    }
    return all.back().configuration;  // not reached: the weights add up to the total
  };
  return Arrangement{
      "recorded",
      "As it occurred near contact in the scenes that come with Touchstone, as often "
      "as it occurred.",
      Arrangement::Orientations::recorded,
      {},
      generate};
}

}  // namespace touchstone
