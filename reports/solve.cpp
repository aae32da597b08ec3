#include "reports/solve.hpp"

#include <cmath>
#include <fmt/format.h>
#include <istream>
#include <limits>
#include <ostream>
#include <string>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"

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

namespace {

json solved(const json& line, const SolveOptions& options,
            std::vector<CandidateProcess>& candidates) {
  if (line.contains("id")) id_of(line);  // has to be one
  const auto [c, swapped] =
      configuration_from_json(line.contains("configuration") ? line["configuration"] : line);
  const Order order = swapped ? Order::swapped : Order::as_ours;
  const oracle::Truth truth = oracle::truth(c, options.width);
  json result;
  if (line.contains("id")) result["id"] = line["id"];
  result["truth"] = to_json(c, truth, order);
  if (options.audit) {
    const audit::Enclosure enclosure = audit::enclose(c);
    check_agreement(c, truth.signed_distance, enclosure);
    result["audit"] = touchstone::to_json(enclosure);
  }
  result["answers"] = json::object();
  for (CandidateProcess& process : candidates) {
    const Answer a = process.answer(c);
    result["answers"][process.candidate().name] =
        to_json(a, score(c, truth, a, options.bar), order);
  }
  return result;
}

json error(std::size_t number, const json& line, const InvalidInput& e) {
  constexpr std::size_t max_field = 200;
  json result = {
      {"line", number}, {"field", printable(e.field(), max_field)}, {"error", error_text(e)}};
  if (line.contains("id") && line["id"].is_primitive()) {
    result["id"] = line["id"];
  }
  return result;
}

}  // namespace

bool solve(std::istream& in, std::ostream& out, const SolveOptions& options) {
  auto candidates = start(options.candidates, options.bar.threshold, options.limits);
  bool good = true;
  JsonLines lines(in);
  while (lines.next()) {
    json line, result;
    try {
      line = lines.parse();
      result = solved(line, options, candidates);
    } catch (const InvalidInput& e) {
      result = error(lines.number(), line, e);
    }
    // Anything else is our own contradiction and ends the program.
    good = good && !result.contains("error");
    out << escaped(result.dump(-1, ' ', false, json::error_handler_t::replace)) << std::endl;
    if (!out) break;  // nobody would see the other answers
  }
  return good;
}

}  // namespace touchstone
