#include <cmath>

#include <nlohmann/json.hpp>

#include "simulation/engines/run_engines.hpp"
#include "simulation/run_experiments.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using Outcome = ExperimentResult::Outcome;

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::measured:
      return "measured";
    case Outcome::unsupported:
      return "unsupported";
    case Outcome::unsound:
      return "unsound";
    case Outcome::crashed:
      return "crashed";
    case Outcome::timed_out:
      return "timed-out";
  }
  return "";
}

json finite(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }

}  // namespace

json to_json(const ExperimentResult& r) {
  json result = {{"experiment", r.experiment},
                 {"candidate", r.candidate},
                 {"step", r.step},
                 {"outcome", name_of(r.outcome)}};
  if (r.outcome == Outcome::unsupported) return result;
  if (r.outcome == Outcome::crashed || r.outcome == Outcome::timed_out) {
    result["reason"] = r.reason;
    return result;
  }
  json details = json::object();
  for (const auto& [name, value] : r.details) details[name] = finite(value);
  result.update({{"value", finite(r.value)},
                 {"error", finite(r.error)},
                 {"exact", r.exact},
                 {"energy_gained", finite(r.energy_gained)},
                 {"points", r.points},
                 {"flicker", r.flicker},
                 {"single", r.single},
                 {"without", r.without},
                 {"failures", r.failures},
                 {"details", details},
                 {"steps", r.steps},
                 {"nanoseconds", r.nanoseconds ? json(*r.nanoseconds) : json(nullptr)},
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
