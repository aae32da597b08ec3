#include "reports/campaigns/magnitudes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "properties/files/json_fields.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

// The bits of a double that is not negative grow with it, so that its first ones number bins in
// order: the sign, eleven of the exponent, three of the mantissa.
constexpr int dropped_bits = 64 - 15;

std::uint16_t bin_of(double magnitude) {
  return static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(magnitude) >> dropped_bits);
}

double lower_end(std::uint64_t bin) { return std::bit_cast<double>(bin << dropped_bits); }

}  // namespace

void Magnitudes::add(double value) {
  constexpr double largest = std::numeric_limits<double>::max();
  const double magnitude = std::isfinite(value) ? std::abs(value) : largest;
  ++bins_[bin_of(magnitude)];
  ++count_;
  max_ = std::max(max_, magnitude);
}

void Magnitudes::add(const Magnitudes& other) {
  for (const auto& [bin, count] : other.bins_) bins_[bin] += count;
  count_ += other.count_;
  max_ = std::max(max_, other.max_);
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

nlohmann::json Magnitudes::to_json() const {
  nlohmann::json bins = nlohmann::json::array();
  for (const auto& [bin, count] : bins_) {
    bins.push_back(bin);
    bins.push_back(count);
  }
  return {{"max", max_}, {"bins", bins}};
}

Magnitudes Magnitudes::from_json(const nlohmann::json& json) {
  Magnitudes result;
  result.max_ = number(member(json, "max", ""), "max");
  if (!(std::isfinite(result.max_) && result.max_ >= 0)) {
    throw InvalidInput("max", shown(json["max"]), "must be finite and not negative");
  }
  const nlohmann::json& bins = member(json, "bins", "");
  if (!bins.is_array() || bins.size() % 2 != 0) {
    throw InvalidInput("bins", shown(bins), "must be an array of pairs");
  }
  for (std::size_t i = 0; i < bins.size(); i += 2) {
    const auto bin = whole_number(bins[i], fmt::format("bins[{}]", i), bin_of(result.max_));
    const auto count =
        whole_number(bins[i + 1], fmt::format("bins[{}]", i + 1), max_count - result.count_);
    result.bins_[static_cast<std::uint16_t>(bin)] += count;
    result.count_ += count;
  }
  return result;
}

}  // namespace touchstone
