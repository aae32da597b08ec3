#include "reports/solve.hpp"

#include <exception>
#include <istream>
#include <ostream>
#include <string>

#include "reference/invalid_input.hpp"
#include "reports/agreement.hpp"
#include "reports/answer_json.hpp"
#include "reports/configuration_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json solved(const json& line, const SolveOptions& options,
            std::vector<CandidateProcess>& candidates) {
  const auto [c, swapped] = configuration_from_json(line);
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
    json& entry = result["answers"][process.candidate().name] =
        to_json(a, score(c, truth, a, options.bar), order);
    if (!a.reason.empty()) entry["reason"] = a.reason;
  }
  return result;
}

json error(std::size_t number, const json& line, const std::string& field,
           const std::string& message) {
  json result = {{"line", number}, {"field", field}, {"error", message}};
  if (line.is_object() && line.contains("id")) result["id"] = line["id"];
  return result;
}

}  // namespace

bool solve(std::istream& in, std::ostream& out, const SolveOptions& options) {
  auto candidates = start(options.candidates, options.bar.threshold, options.limits);
  bool good = true;
  std::string text;
  for (std::size_t number = 1; std::getline(in, text); ++number) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    json line, result;
    try {
      line = json::parse(text);
      result = solved(line, options, candidates);
    } catch (const InvalidInput& e) {
      result = error(number, line, e.field(), e.what());
    } catch (const json::exception& e) {
      result = error(number, line, "line", std::string("is no JSON object: ") + e.what());
    }
    // Anything else is our own contradiction and ends the program.
    good = good && !result.contains("error");
    out << result.dump(-1, ' ', false, json::error_handler_t::replace) << std::endl;
  }
  return good;
}

}  // namespace touchstone
