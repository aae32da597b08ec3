#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

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

namespace {

double number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

}  // namespace

json to_json(const ExperimentResults& r) {
  json experiments = json::array(), results = json::array();
  for (const ExperimentDescription& e : r.experiments) experiments.push_back(to_json(e));
  for (const ExperimentResult& each : r.results) results.push_back(to_json(each));
  return {{"steps", r.steps}, {"experiments", experiments}, {"results", results}};
}

std::string to_text(const ExperimentResult& result) { return to_json(result).dump(); }

ExperimentResult result_from_text(const std::string& text) {
  const json value = json::parse(text);
  ExperimentResult r;
  r.experiment = value["experiment"];
  r.candidate = value["candidate"];
  r.step = value["step"];
  for (const Outcome outcome : {Outcome::measured, Outcome::unsupported, Outcome::unsound,
                                Outcome::crashed, Outcome::timed_out}) {
    if (value["outcome"] == name_of(outcome)) r.outcome = outcome;
  }
  if (value.contains("reason")) r.reason = value["reason"];
  if (!value.contains("value")) return r;
  r.value = number(value["value"]);
  r.error = number(value["error"]);
  r.exact = value["exact"];
  r.energy_gained = number(value["energy_gained"]);
  r.points = value["points"];
  r.flicker = value["flicker"];
  r.single = value["single"];
  r.without = value["without"];
  r.failures = value["failures"];
  for (const auto& [name, detail] : value["details"].items()) r.details[name] = number(detail);
  r.steps = value["steps"];
  if (!value["nanoseconds"].is_null()) r.nanoseconds = value["nanoseconds"].get<double>();
  r.microseconds_per_step = value["microseconds_per_step"];
  r.last_motion = value["last_motion"];
  r.last_time = value["last_time"];
  return r;
}

namespace {

using Outcome = ExperimentResult::Outcome;

std::string number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string row(const ExperimentResult& r) {
  if (r.outcome == Outcome::unsupported) return fmt::format("  {:<21} unsupported\n", r.candidate);
  return fmt::format("  {:<21}{}{:>10} {:>7} {:>6.1f} {:>7.1f} {:>6} {:>8} {:>7.0f}\n", r.candidate,
                     r.exact ? '=' : ' ', number(r.value, "{:.3g}"),
                     r.outcome == Outcome::unsound ? "unsound" : number(r.error, "{:.1e}"),
                     r.points, 100 * r.flicker, number(r.energy_gained, "{:.0e}"),
                     r.nanoseconds ? fmt::format("{:.0f}", *r.nanoseconds) : "-",
                     r.microseconds_per_step);
}

}  // namespace

std::string experiments_table(const ExperimentResults& all) {
  std::string text =
      fmt::format("{:<24}{:>10} {:>7} {:>6} {:>7} {:>6} {:>8} {:>7}\n", "experiment, candidate",
                  "value", "error", "points", "flicker", "gained", "ns/query", "us/step");
  for (const ExperimentDescription& e : all.experiments) {
    for (std::size_t k = 0; k < all.steps.size(); ++k) {
      text += fmt::format("\n{}, step {:.3g} s: {}\n  on paper {:.4g}, resolved to {:.1g} ({})\n",
                          e.name, all.steps[k], e.quantity, e.expected[k], e.resolution[k], e.unit);
      for (const ExperimentResult& r : all.results) {
        if (r.experiment == e.name && r.step == all.steps[k]) text += row(r);
      }
    }
  }
  return text +
         "\n=: held: within what the experiment resolves, where all are equal\n"
         "value and error: as the headings say\n"
         "points: mean number of contact points; flicker: % of steps in which it changed\n"
         "gained: largest rise of energy, in weight x size\n"
         "ns: median of one query; us: of a whole step, the way to the candidate included\n";
}

namespace {

/// The time after which nothing moved; "jitter" if it is at rest in the mean, as it should, but
/// single steps still move it; "never" if it moved in the last steps; "-" where motion is what is
/// measured.
std::string time_to_rest(const ExperimentResult& r, const ExperimentDescription& e) {
  if (!e.rests) return "-";
  if (r.comes_to_rest()) return fmt::format("{:.2f}", r.last_motion);
  return r.exact ? "jitter" : "never";
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
         "rests: time after which nothing moves, s; jitter: at rest in the mean, as it should,\n"
         "but single steps still move; gained: rise of energy, weight x size\n";
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
