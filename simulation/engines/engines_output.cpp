#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "simulation/engines/run_engines.hpp"

namespace touchstone {
namespace {

using Outcome = ExperimentResult::Outcome;

std::string number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

/// The time after which nothing moved; "never" if it still did in the last steps, "-" where motion
/// is what is measured.
std::string time_to_rest(const ExperimentResult& r, const ExperimentDescription& e) {
  if (!e.rests) return "-";
  if (r.comes_to_rest()) return fmt::format("{:.2f}", r.last_motion);
  return "never";
}

std::string row(const std::string& name, const ExperimentResult& r, const ExperimentDescription& e,
                const std::string& cure) {
  if (r.outcome == Outcome::crashed || r.outcome == Outcome::timed_out) {
    return fmt::format("  {:<22}{}\n", name, r.reason);
  }
  const std::string error = r.outcome == Outcome::unsound ? "unsound" : number(r.error, "{:.1e}");
  return fmt::format("  {:<22}{}{:>8} {:>8} {:>6.1f} {:>6} {:>6} {:>7.1f}  {}\n", name,
                     r.exact ? '=' : ' ', number(r.value, "{:.3g}"), error, r.points,
                     time_to_rest(r, e), number(r.energy_gained, "{:.0e}"), r.microseconds_per_step,
                     cure);
}

std::string rows(const EngineResult& r, const ExperimentDescription& e) {
  const std::string ours = r.engine + "+touchstone";
  std::string text = row(r.engine, r.own, e, "") + row(ours, r.cured, e, cure_name(r.cure));
  if (r.best) {
    const bool is_halved = r.best->step < r.cured.step;
    text += row(is_halved ? "  best, half the step" : "  solver at its best", *r.best, e, "");
  }
  return text;
}

std::string counts(const EngineResults& all) {
  std::string text;
  for (const Cure cure : {Cure::held, Cure::nearer, Cure::solver, Cure::alike, Cure::open}) {
    const auto count = std::count_if(all.results.begin(), all.results.end(),
                                     [&](const EngineResult& r) { return r.cure == cure; });
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, cure_name(cure));
  }
  return text;
}

}  // namespace

std::string engines_table(const EngineResults& all) {
  std::string text =
      fmt::format("{:<24} {:>8} {:>8} {:>6} {:>6} {:>6} {:>7}\n", "experiment, contacts", "value",
                  "error", "points", "rests", "gained", "us/step");
  for (const ExperimentDescription& e : all.experiments) {
    text += fmt::format("\n{}: {}\n  on paper {:.4g}, resolved to {:.1g} ({})\n", e.name,
                        e.quantity, e.expected[0], e.resolution[0], e.unit);
    for (const EngineResult& r : all.results) {
      if (r.experiment == e.name) text += rows(r, e);
    }
  }
  text += fmt::format("\nEach engine in its own world, steps of {:.3g} s; {} in all: {}.\n",
                      all.step, all.results.size(), counts(all));
  for (const EngineDescription& e : all.engines) {
    text += fmt::format("{} {}: {}\n  solver at its best: {}\n", e.name, e.version, e.settings,
                        e.best_settings);
  }
  return text +
         "+touchstone: with our contact routines installed in the engine\n"
         "=, held: within what the experiment resolves; nearer: ten times nearer or more\n"
         "solver: held with the engine's solver at its best, which is thus what limits\n"
         "alike: as near as the engine's own contacts, also with the solver at its best\n"
         "rests: time after which nothing moves, s; gained: rise of energy, weight x size\n";
}

std::string engines_summary(const EngineResults& all) {
  std::string text = fmt::format("{:<16}", "error");
  for (const EngineDescription& e : all.engines) text += fmt::format(" {:<20}", e.name);
  const auto brief = [](const ExperimentResult& r) {
    return r.outcome == Outcome::measured ? number(r.error, "{:.1e}") : std::string("lost");
  };
  for (const ExperimentDescription& e : all.experiments) {
    text += fmt::format("\n{:<16}", e.name);
    for (const EngineResult& r : all.results) {
      if (r.experiment != e.name) continue;
      const char* mark = r.cure == Cure::held     ? " ="
                         : r.cure == Cure::nearer ? " +"
                         : r.cure == Cure::solver ? " *"
                                                  : "";
      text += fmt::format(" {:<20}", brief(r.own) + " -> " + brief(r.cured) + mark);
    }
    text.erase(text.find_last_not_of(' ') + 1);
  }
  return text +
         "\n\nIn each engine's own world, with its contacts -> with ours: = held, as on paper;\n"
         "+ ten times nearer; * held with the engine's solver at its best\n";
}

nlohmann::json to_json(const EngineResults& all) {
  using nlohmann::json;
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
