#pragma once

#include <boost/container/flat_map.hpp>
#include <cstdint>
#include <optional>

#include <nlohmann/json.hpp>

#include "reports/statistics.hpp"

namespace touchstone {

/// Counts of magnitudes in bins of an eighth of an octave's width, from zero to the largest double,
/// and the exact largest. Only integers are added: whatever the order and the parts, the sum is the
/// same to the last bit. Memory grows with the octaves that occur, not with the count.
class Magnitudes {
 public:
  /// More than can be scored in years; sums and percentiles do not overflow, not even of all pose
  /// classes together.
  static constexpr std::uint64_t max_count = 1'000'000'000'000;

  /// Of |value|. What is not finite counts as the largest double.
  void add(double value);
  void add(const Magnitudes& other);

  std::uint64_t count() const { return count_; }
  double max() const { return max_; }

  /// Bounds, at most an eighth apart, of the ⌈n·percent/100⌉-th smallest of n values; absent
  /// without values.
  std::optional<Bounds> percentile(std::uint64_t percent) const;

  /// {"max", "bins": [number, count, number, count, …]}; bin i holds the doubles whose first 14
  /// bits (sign, exponent and three of the mantissa) are i.
  nlohmann::json to_json() const;
  /// Throws InvalidInput on anything else than to_json gives.
  static Magnitudes from_json(const nlohmann::json& json);

 private:
  boost::container::flat_map<std::uint16_t, std::uint64_t> bins_;
  std::uint64_t count_ = 0;
  double max_ = 0;
};

}  // namespace touchstone
