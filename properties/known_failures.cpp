#include "properties/known_failures.hpp"

#include <algorithm>
#include <array>

namespace touchstone {
namespace {

struct Row {
  Pair pair;
  std::vector<double> numbers;  ///< in the order of every_number
};

/// Failures of our own routines, then those of engines in known_failures.jsonl. Frozen: the hostile
/// class chooses from them by number.
const Row rows[] = {
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

Numbers numbers_of_row(const Row& row) {
  Numbers result;
  result.pair = row.pair;
  result.sizes.resize(size_count(row.pair));
  std::size_t i = 0;
  for (double* number : every_number(result)) *number = row.numbers[i++];
  return result;
}

/// Without the configurations that an earlier row of the pair has: several laws may fail at one.
std::vector<Numbers> distinct_rows(Pair pair) {
  std::vector<const Row*> distinct;
  for (const Row& row : rows) {
    const bool repeated = std::any_of(distinct.begin(), distinct.end(),
                                      [&](const Row* r) { return r->numbers == row.numbers; });
    if (row.pair == pair && !repeated) distinct.push_back(&row);
  }
  std::vector<Numbers> result;
  for (const Row* row : distinct) result.push_back(numbers_of_row(*row));
  return result;
}

}  // namespace

const std::vector<Numbers>& known_failures(Pair pair) {
  static const auto all = [] {
    std::array<std::vector<Numbers>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) result[static_cast<std::size_t>(p)] = distinct_rows(p);
    return result;
  }();
  return all[static_cast<std::size_t>(pair)];
}

}  // namespace touchstone
