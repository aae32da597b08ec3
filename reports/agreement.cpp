#include "reports/agreement.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "properties/files/configuration_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr int digits = 17;

/// An enclosure that overflowed on that side says nothing there.
json end_of(double value, std::string (*decimal)(const mpq_class&, int)) {
  return std::isfinite(value) ? json(decimal(mpq_class(value), digits)) : json(nullptr);
}

bool is_above(double value, const mpq_class& exact) {
  return std::isfinite(value) ? mpq_class(value) > exact : value > 0;
}
bool is_below(double value, const mpq_class& exact) {
  return std::isfinite(value) ? mpq_class(value) < exact : value < 0;
}

}  // namespace

void check_agreement(const Configuration& configuration, const oracle::Enclosure& truth,
                     const audit::Enclosure& audit) {
  if (!is_above(audit.lo, truth.hi) && !is_below(audit.hi, truth.lo) &&
      !is_below(audit.pair_distance, truth.lo)) {
    return;
  }
  throw Contradiction(fmt::format(
      "the oracles contradict each other: the first encloses the signed distance in [{}, {}], the "
      "second in [{:.17g}, {:.17g}] with two points {:.17g} apart, for {}",
      oracle::decimal_below(truth.lo, 20), oracle::decimal_above(truth.hi, 20), audit.lo, audit.hi,
      audit.pair_distance, to_hex_json(configuration).dump()));
}

json to_json(const audit::Enclosure& audit) {
  const double difference = audit.pair_distance - audit.lo;
  const double primal_dual =
      difference > 0 ? std::nextafter(difference, std::numeric_limits<double>::infinity()) : 0;
  return {{"signed_distance",
           {end_of(audit.lo, oracle::decimal_below), end_of(audit.hi, oracle::decimal_above)}},
          {"primal_dual_gap",
           audit.lo > 0 && std::isfinite(primal_dual) ? json(primal_dual) : json(nullptr)}};
}

}  // namespace touchstone
