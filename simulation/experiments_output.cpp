#include <nlohmann/json.hpp>

#include "properties/files/strict_json.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/run_experiments.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using Outcome = ExperimentResult::Outcome;

/// By outcome.
constexpr const char* outcome_names[] = {"measured", "unsupported", "unsound", "crashed",
                                         "timed-out"};

}  // namespace

json to_json(const ExperimentResult& r) {
  json result = {{"experiment", r.experiment},
                 {"candidate", r.candidate},
                 {"step", r.step},
                 {"outcome", outcome_names[static_cast<int>(r.outcome)]}};
  if (r.outcome == Outcome::unsupported) return result;
  if (r.outcome == Outcome::crashed || r.outcome == Outcome::timed_out) {
    result["reason"] = r.reason;
    return result;
  }
  json details = json::object();
  for (const auto& [name, value] : r.details) details[name] = or_null(value);
  result.update({{"value", or_null(r.value)},
                 {"error", or_null(r.error)},
                 {"exact", r.exact},
                 {"energy_gained", or_null(r.energy_gained)},
                 {"points", r.points},
                 {"flicker", r.flicker},
                 {"single", r.single},
                 {"without", r.without},
                 {"failures", r.failures},
                 {"details", details},
                 {"steps", r.steps},
                 {"nanoseconds", or_null(r.nanoseconds)},
                 {"microseconds_per_step", r.microseconds_per_step},
                 {"last_motion", r.last_motion},
                 {"last_time", r.last_time}});
  return result;
}

json to_json(const ExperimentDescription& e) {
  return {{"name", e.name},  {"statement", e.statement}, {"quantity", e.quantity},
          {"unit", e.unit},  {"expected", e.expected},   {"resolution", e.resolution},
          {"rests", e.rests}};
}

json to_json(const ExperimentResults& r) {
  json experiments = json::array(), results = json::array();
  for (const ExperimentDescription& e : r.experiments) experiments.push_back(to_json(e));
  for (const ExperimentResult& each : r.results) results.push_back(to_json(each));
  return {{"steps", r.steps}, {"experiments", experiments}, {"results", results}};
}

nlohmann::json to_json(const EngineResults& all) {
  json engines = json::array(), experiments = json::array(), results = json::array();
  for (const EngineDescription& e : all.engines) {
    engines.push_back({{"name", e.name},
                       {"version", e.version},
                       {"settings", e.settings},
                       {"best_settings", e.best_settings}});
  }
  for (const ExperimentDescription& e : all.experiments) experiments.push_back(to_json(e));
  for (const EngineResult& r : all.results) {
    results.push_back({{"experiment", r.experiment},
                       {"engine", r.engine},
                       {"cure", cure_name(r.cure)},
                       {"own", to_json(r.own)},
                       {"cured", to_json(r.cured)},
                       {"best", r.best ? to_json(*r.best) : json(nullptr)}});
  }
  return {
      {"step", all.step}, {"engines", engines}, {"experiments", experiments}, {"results", results}};
}

}  // namespace touchstone
