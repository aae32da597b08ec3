#include "reports/second_oracle.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// An end that overflowed is null: it bounds nothing.
json end_of(double value, std::string (*decimal)(const mpq_class&, int)) {
  return std::isfinite(value) ? json(decimal(mpq_class(value), 17)) : json(nullptr);
}

json exact(const audit::RationalVector& v) {
  return json::array({v[0].get_str(), v[1].get_str(), v[2].get_str()});
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

std::string certificate_json(const audit::Certificate& certificate,
                             const Configuration& configuration) {
  const double size = larger_size(configuration);
  const mpq_class width = (certificate.hi - certificate.lo) / mpq_class(size);
  json result = {{"schema", "touchstone-certificate-1"},
                 {"configuration", to_hex_json(configuration)},
                 {"exact", to_exact_json(configuration)},
                 {"signed_distance", {certificate.lo.get_str(), certificate.hi.get_str()}},
                 {"grain", certificate.grain.get_str()},
                 {"width", width.get_d()},
                 {"normal", exact(certificate.normal)}};
  if (certificate.pair) {
    result["pair"] = {{"a", exact(certificate.pair->a)}, {"b", exact(certificate.pair->b)}};
    return result.dump();
  }
  result["cells"] = json::array();
  for (const auto& cell : certificate.cells) {
    result["cells"].push_back(
        {{"cell", cell.path}, {"a", exact(cell.pair.a)}, {"b", exact(cell.pair.b)}});
  }
  return result.dump();
}

}  // namespace touchstone
