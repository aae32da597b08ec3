#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/run.hpp"

namespace touchstone {

/// What came of an experiment with one contact model at one step.
struct Measurement {
  double value;    ///< the experiment's quantity
  double error;    ///< from the value on paper, as the experiment's unit says
  RunTally tally;  ///< of all its runs
  std::vector<std::pair<std::string, double>> details = {};  ///< by name, as in docs/simulation.md
};

/// A scene, or a few, whose outcome is known on paper.
struct Experiment {
  using OfStep = std::function<double(double step)>;

  std::string name;       ///< as on the command line: "rolling"
  std::string statement;  ///< what must happen, in one sentence
  std::string quantity;   ///< that is measured, with its unit
  std::string unit;       ///< of the error
  /// Runs it with a step in seconds. A model that lacks a pair ends it early
  /// (RunTally::unsupported).
  std::function<Measurement(ContactModel& model, double step)> run;
  OfStep expected;  ///< the value on paper at that step
  /// Exact contacts may have an error up to this, whichever points they consist of: of the
  /// integrator, the solver, the surface layer, the bisection (resolution.hpp). Candidates with
  /// smaller errors are equal.
  OfStep resolution;
  bool rests = false;  ///< the value is a motion that must die away
};

/// In report order.
const std::vector<Experiment>& all_experiments();

/// Throws InvalidInput (field "experiment") naming those there are.
const Experiment& find_experiment(const std::string& name);

// Of which all_experiments is made, by what they ask.
std::vector<Experiment> resting_experiments();    ///< does what is at rest stay there?
std::vector<Experiment> moving_experiments();     ///< does what moves keep to its law?
std::vector<Experiment> threshold_experiments();  ///< up to which angle, friction, overhang, speed?

}  // namespace touchstone
