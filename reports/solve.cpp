#include "reports/solve.hpp"

#include <istream>
#include <ostream>
#include <string>

#include <nlohmann/json.hpp>

#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/second_oracle.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json solved(const json& line, const SolveOptions& options,
            std::vector<CandidateProcess>& candidates) {
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
    result["audit"] = to_json(enclosure);
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
  if (line.is_object() && line.contains("id")) result["id"] = line["id"];
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
    out << result.dump(-1, ' ', false, json::error_handler_t::replace) << std::endl;
    if (!out) break;  // nobody would see the other answers
  }
  return good;
}

}  // namespace touchstone
