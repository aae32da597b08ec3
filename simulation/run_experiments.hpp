#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "candidates/host/candidate_process.hpp"
#include "properties/files/named_members.hpp"

namespace touchstone {

struct Experiment;
struct Measurement;

/// Which experiments to run, with which candidates, at which steps.
struct ExperimentOptions {
  std::vector<const Experiment*> experiments;
  std::vector<const Candidate*> candidates;
  std::vector<double> steps = {1.0 / 240};  ///< s
  unsigned workers = 1;                     ///< processes; the results do not depend on them
  Limits limits;
};

/// Outcome of one experiment with one candidate at one step (docs/experiments.schema.json). If the
/// outcome is `unsupported`, `crashed` or `timed_out`, the numbers after it have no meaning.
struct ExperimentResult {
  enum class Outcome {  // in the order of their names in experiments_output.cpp
    measured,
    unsupported,  ///< the candidate has no routine for a pair that occurred
    unsound,      ///< the motion ended beyond all bounds
    crashed,      ///< an engine ended its process (`reason`)
    timed_out,    ///< an engine took too long
  };
  std::string experiment, candidate;
  double step = 0;  ///< s
  Outcome outcome = Outcome::measured;
  double value = 0, error = 0;  ///< may be infinite or NaN
  bool exact = false;        ///< within the experiment's resolution, and at rest where it should be
  double energy_gained = 0;  ///< largest rise above an earlier energy, in weight × size
  double points = 0;         ///< mean number of contact points
  double flicker = 0, single = 0, without = 0;  ///< shares of steps, as in RunTally
  std::uint64_t failures = 0;                   ///< answers other than contact or none
  std::map<std::string, double> details;
  std::uint64_t steps = 0;            ///< of all runs
  std::optional<double> nanoseconds;  ///< median of a query; absent: could not be timed
  double microseconds_per_step = 0;   ///< wall-clock time, solver and communication included
  double last_motion = 0;             ///< time, s, after which nothing moved in the last run
  double last_time = 0;               ///< end of that run, s
  std::string reason = {};            ///< of a crash

  /// Whether nothing moved in the last half second of the last run.
  bool comes_to_rest() const;
};
inline constexpr std::array experiment_outcomes = {
    ExperimentResult::Outcome::measured, ExperimentResult::Outcome::unsupported,
    ExperimentResult::Outcome::unsound, ExperimentResult::Outcome::crashed,
    ExperimentResult::Outcome::timed_out};
inline const auto& values_of(ExperimentResult::Outcome) { return experiment_outcomes; }
const char* name_of(ExperimentResult::Outcome outcome);

template <class Archive>
void members(Archive& a, ExperimentResult& r) {
  using Outcome = ExperimentResult::Outcome;
  a.named("experiment", r.experiment);
  a.named("candidate", r.candidate);
  a.named("step", r.step, rule::positive);
  a.named("outcome", r.outcome);
  if (r.outcome == Outcome::crashed || r.outcome == Outcome::timed_out) {
    a.named("reason", r.reason);
  }
  if (r.outcome != Outcome::measured && r.outcome != Outcome::unsound) return;
  a.named("value", r.value, rule::any_or_null);
  a.named("error", r.error, rule::any_or_null);
  a.named("exact", r.exact);
  a.named("energy_gained", r.energy_gained, rule::any_or_null);
  a.named("points", r.points, rule::not_negative);
  a.named("flicker", r.flicker, rule::share);
  a.named("single", r.single, rule::share);
  a.named("without", r.without, rule::share);
  a.named("failures", r.failures);
  a.named("details", r.details, rule::any_or_null);
  a.named("steps", r.steps);
  a.named("nanoseconds", r.nanoseconds, rule::not_negative);
  a.named("microseconds_per_step", r.microseconds_per_step, rule::not_negative);
  a.named("last_motion", r.last_motion);
  a.named("last_time", r.last_time, rule::not_negative);
}

struct ExperimentDescription {
  std::string name, statement, quantity, unit;  ///< as in Experiment
  std::vector<double> expected, resolution;     ///< for each step
  bool rests = false;                           ///< as in Experiment
};
template <class Archive>
void members(Archive& a, ExperimentDescription& e) {
  a.named("name", e.name);
  a.named("statement", e.statement);
  a.named("quantity", e.quantity);
  a.named("unit", e.unit);
  a.named("expected", e.expected);
  a.named("resolution", e.resolution, rule::not_negative);
  a.named("rests", e.rests);
}

/// Results of all experiments with all candidates at all steps.
struct ExperimentResults {
  std::vector<double> steps;  ///< s
  std::vector<ExperimentDescription> experiments;
  std::vector<ExperimentResult> results;
};
template <class Archive>
void members(Archive& a, ExperimentResults& r) {
  a.named("steps", r.steps, rule::positive);
  a.named("experiments", r.experiments);
  a.named("results", r.results);
}

/// Runs every experiment with every candidate at every step. Times aside the results depend on the
/// options alone. Progress goes to standard error. After an interruption (interruption.hpp) the
/// results of what was not done are missing.
ExperimentResults run_experiments(const ExperimentOptions& options);

/// Judges a measurement. `candidate`: whose contacts it was made with.
ExperimentResult result_of(const Experiment& experiment, const std::string& candidate, double step,
                           const Measurement& measurement);

ExperimentDescription describe(const Experiment& experiment, const std::vector<double>& steps);

/// The member `experiments` of report.json (docs/experiments.schema.json), and parts of it; null
/// for what is not finite.
nlohmann::json to_json(const ExperimentResults& results);
nlohmann::json to_json(const ExperimentDescription& experiment);
nlohmann::json to_json(const ExperimentResult& result);

}  // namespace touchstone
