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

struct FailedRow {
  Pair pair;
  std::vector<double> numbers;  ///< in the order of every_number
};

/// Failures of our own routines, then those of engines in known_failures.jsonl. Frozen: the hostile
/// class chooses from them by number.
const FailedRow failed_rows[] = {
    // A zero normal at a tilt of 1e-14.
    {Pair::capsule,
     {0x1p-2, 5, 0x1.1745d1745d174p-2, -0x1.ac37dac37dac4p-2, 0x1.bed61bed61bfp-6,
      0x1.041c6a547a96ep+1, -0x1.78c73ac4b8bf4p+1, -0x1.1fa452869f12cp-7, -0x1.847b2902f586dp+1,
      0x1p-2, 5, 0, 0, 0, 2, -3, 0, -3}},
    // A missed contact of the rims of perpendicular cylinders.
    {Pair::cylinder,
     {1, 2, -0x1.eb851eb851eb8p-2, -0x1.b0a3d70a3d70ap+1, 0x1.547ae147ae148p+1, 1,
      0x1.0000005e7d418p+0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0}},
    // Contact points none of which has the depth.
    {Pair::box,
     {0x1.97c35abda3eebp-1, 0x1.93973dd550fddp-1, -0x1.81d3ed9e3d37ap-3, 0x1.da6972f3aa68cp-1,
      -0x1.68700f31523a4p-1, 1, 0x1.11baa155417aap-47, -0x1.0bb9b6876a42ap-48,
      0x1.b171ba7780121p-19, 0x1.2867f0a3b4efbp-2, 0x1.2867f0a3b4efbp-2, 0x1.5939751ff6014p-4,
      0x0.0000000000001p-1022, 0, 0, 1, 0, 0, 0}},
#include "known_failures_rows.inc"
};

Numbers numbers_of_row(const FailedRow& row) {
  Numbers result;
  result.pair = row.pair;
  result.sizes.resize(size_count(row.pair));
  std::size_t i = 0;
  for (double* number : every_number(result)) *number = row.numbers[i++];
  return result;
}

/// Without the configurations that an earlier row of the pair has: several laws may fail at one.
std::vector<Numbers> distinct_rows(Pair pair) {
  std::vector<const FailedRow*> distinct;
  for (const FailedRow& row : failed_rows) {
    const bool repeated = std::any_of(distinct.begin(), distinct.end(), [&](const FailedRow* r) {
      return r->numbers == row.numbers;
    });
    if (row.pair == pair && !repeated) distinct.push_back(&row);
  }
  std::vector<Numbers> result;
  for (const FailedRow* row : distinct) result.push_back(numbers_of_row(*row));
  return result;
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

const std::vector<Numbers>& known_failures(Pair pair) {
  static const auto all = [] {
    std::array<std::vector<Numbers>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) result[static_cast<std::size_t>(p)] = distinct_rows(p);
    return result;
  }();
  return all[static_cast<std::size_t>(pair)];
}

}  // namespace touchstone
