#include "reports/magnitudes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace touchstone {
namespace {

constexpr int dropped_bits = 64 - 15;

double lower_end(std::uint64_t bin) { return std::bit_cast<double>(bin << dropped_bits); }

}  // namespace

std::uint16_t Magnitudes::bin_of(double magnitude) {
  // The bits of a double that is not negative grow with it, so that bins are numbered in order.
  return static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(magnitude) >> dropped_bits);
}

Magnitudes::Magnitudes(Bins bins, double max)
    : precision_(Precision::binned), bins_(std::move(bins)), max_(max) {
  for (const auto& [bin, count] : bins_) count_ += count;
}

Magnitudes::Magnitudes(std::vector<double> values)
    : precision_(Precision::exact), values_(std::move(values)), count_(values_.size()) {
  for (const double value : values_) max_ = std::max(max_, value);
}

void Magnitudes::add(double value) {
  double magnitude = std::abs(value);
  if (precision_ == Precision::exact) {
    values_.push_back(magnitude);
  } else {
    if (!std::isfinite(magnitude)) magnitude = std::numeric_limits<double>::max();
    ++bins_[bin_of(magnitude)];
  }
  ++count_;
  max_ = std::max(max_, magnitude);
}

void Magnitudes::add(const Magnitudes& other) {
  for (const auto& [bin, count] : other.bins_) bins_[bin] += count;
  values_.insert(values_.end(), other.values_.begin(), other.values_.end());
  count_ += other.count_;
  max_ = std::max(max_, other.max_);
}

std::optional<Quantiles> Magnitudes::quantiles() const {
  if (precision_ == Precision::exact) return touchstone::quantiles(values_);
  const auto median = percentile(50), p99 = percentile(99);
  if (!median) return std::nullopt;
  return Quantiles{median->upper, p99->upper, max_, median, p99};
}

std::optional<Bounds> Magnitudes::percentile(std::uint64_t percent) const {
  if (count_ == 0) return std::nullopt;
  const std::uint64_t rank = (percent * count_ + 99) / 100;
  std::uint64_t seen = 0;
  for (const auto& [bin, count] : bins_) {
    seen += count;
    if (seen >= rank) return Bounds{lower_end(bin), std::min(lower_end(bin + 1U), max_)};
  }
  return Bounds{max_, max_};
}

}  // namespace touchstone
