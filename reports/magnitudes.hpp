#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "reports/statistics.hpp"

namespace touchstone {

/// How magnitudes are kept.
enum class Precision {
  exact,  ///< every value: exact quantiles; memory grows with the number of values
  binned  ///< counts of bins and the maximum: bounds of quantiles; memory stays flat
};

/// Magnitudes |value| of which quantiles are wanted. Sums of parts, added in any order, have the
/// same quantiles; binned, the same bits. A bin is an eighth of an octave wide; bins reach from
/// zero to the largest double.
class Magnitudes {
 public:
  /// More than can be scored in years; sums and percentiles do not overflow, not even of all pose
  /// classes together.
  static constexpr std::uint64_t max_count = 1'000'000'000'000;
  /// The first 15 bits of a double that is not negative (sign, exponent, three of the mantissa)
  /// number its bin.
  using Bins = std::map<std::uint16_t, std::uint64_t>;
  static std::uint16_t bin_of(double magnitude);

  explicit Magnitudes(Precision precision) : precision_(precision) {}
  /// Binned ones that were kept elsewhere.
  Magnitudes(Bins bins, double max);
  /// Exact ones that were kept elsewhere.
  explicit Magnitudes(std::vector<double> values);

  /// Binned, what is not finite counts as the largest double.
  void add(double value);
  /// Adds magnitudes of the same precision.
  void add(const Magnitudes& other);

  Precision precision() const { return precision_; }
  std::uint64_t count() const { return count_; }
  double max() const { return max_; }
  const Bins& bins() const { return bins_; }                     ///< empty where exact
  const std::vector<double>& values() const { return values_; }  ///< empty where binned

  /// Absent without values.
  std::optional<Quantiles> quantiles() const;
  /// Binned: bounds, at most an eighth apart, of the ⌈n·percent/100⌉-th smallest of n values.
  std::optional<Bounds> percentile(std::uint64_t percent) const;

 private:
  Precision precision_;
  Bins bins_;
  std::vector<double> values_;
  std::uint64_t count_ = 0;
  double max_ = 0;
};

}  // namespace touchstone
