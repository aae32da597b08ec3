#include <cmath>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "simulation/engines/run_engines.hpp"

namespace touchstone {
namespace {

using Outcome = ExperimentResult::Outcome;

const ExperimentResult* find(const EngineResults& all, const std::string& experiment,
                             const std::string& candidate) {
  for (const ExperimentResult& r : all.runs.results) {
    if (r.experiment == experiment && r.candidate == candidate) return &r;
  }
  return nullptr;
}

std::string number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string row(const ExperimentResult& r) {
  switch (r.outcome) {
    case Outcome::crashed:
      return fmt::format("  {:<24}crashed: {}\n", r.candidate, r.reason);
    case Outcome::timed_out:
      return fmt::format("  {:<24}took too long\n", r.candidate);
    default:
      break;
  }
  return fmt::format("  {:<24}{}{:>9} {:>8} {:>7.1f} {:>7.2f} {:>7} {:>7.1f}\n", r.candidate,
                     r.exact ? '=' : ' ', number(r.value, "{:.3g}"),
                     r.outcome == Outcome::unsound ? "unsound" : number(r.error, "{:.1e}"),
                     r.points, r.last_motion, number(r.energy_gained, "{:.0e}"),
                     r.microseconds_per_step);
}

}  // namespace

std::string engines_table(const EngineResults& all) {
  std::string text =
      fmt::format("{:<26}{:>10} {:>8} {:>7} {:>7} {:>7} {:>7}\n", "experiment, engine", "value",
                  "error", "points", "moves s", "gained", "us/step");
  for (const ExperimentDescription& e : all.runs.experiments) {
    text += fmt::format("\n{}: {}\n  on paper {:.4g}, resolved to {:.1g} ({})\n", e.name,
                        e.quantity, e.expected[0], e.resolution[0], e.unit);
    for (const EngineDescription& engine : all.engines) {
      for (const std::string& name : {engine.name, cured_name(engine.name)}) {
        if (const ExperimentResult* r = find(all, e.name, name)) text += row(*r);
      }
    }
  }
  text += fmt::format("\nEach engine in its own world and solver, steps of {:.3g} s.\n",
                      all.runs.steps[0]);
  for (const EngineDescription& e : all.engines) {
    text += fmt::format("{} {}: {}\n", e.name, e.version, e.settings);
  }
  return text +
         "+touchstone: with our contact routines installed in it\n"
         "=: held: within what the experiment resolves\n"
         "moves: time after which all bodies were at rest\n";
}

nlohmann::json to_json(const EngineResults& all) {
  nlohmann::json result = to_json(all.runs), engines = nlohmann::json::array();
  for (const EngineDescription& e : all.engines) {
    engines.push_back({{"name", e.name}, {"version", e.version}, {"settings", e.settings}});
  }
  result["engines"] = engines;
  return result;
}

}  // namespace touchstone
