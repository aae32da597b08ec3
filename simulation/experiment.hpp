#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/scene.hpp"

namespace touchstone {

class ContactModel;

/// Simulates in our own world with the contacts of `model`, which must outlive the simulations.
Simulator in_our_world(ContactModel& model);

/// Counts over the steps of one or more runs.
struct RunTally {
  std::uint64_t steps = 0;
  std::uint64_t points = 0;       ///< contact points, summed over the steps
  std::uint64_t flickers = 0;     ///< steps whose number of points differs from the step before
  std::uint64_t single = 0;       ///< steps with exactly one contact point
  std::uint64_t without = 0;      ///< steps with none
  std::uint64_t failures = 0;     ///< answers other than contact or none
  double energy_gained = 0;       ///< largest rise above an earlier energy, in weight × size
  bool unsupported = false;       ///< the candidate has no routine for a pair that occurred
  std::optional<double> unsound;  ///< time at which the simulation became unsound, s
  // Of the last run, s: the time of its last step above `rest_energy`, and its end.
  double last_motion = 0, last_time = 0;
  double seconds = 0;  ///< wall-clock time of all steps

  void add(const RunTally& other);
};

/// One run of a scene, with its tally.
class Run {
 public:
  /// The weight of all moving bodies times `size`, metres, is the unit of energy.
  Run(const Scene& scene, const Simulator& simulator, double size);

  /// False when the duration is over, the simulation is unsound, or a pair is unsupported.
  bool step();
  double time() const { return static_cast<double>(tally_.steps) * scene_.step; }  ///< s
  const std::vector<BodyState>& states() const { return simulation_->states(); }
  const RunTally& tally() const { return tally_; }
  /// Kinetic energy of all moving bodies, in weight × size.
  double kinetic_energy() const { return kinetic_joules() / energy_unit_; }

 private:
  double kinetic_joules() const;
  /// State of a body's centre of mass.
  BodyState at_mass(std::size_t body) const;
  double energy() const;  ///< J; that of gravity is zero at the origin

  Scene scene_;
  std::vector<PosedInertia> inertias_;  ///< by body; zero where it is fixed
  std::unique_ptr<Simulation> simulation_;
  std::uint64_t steps_;  ///< of the whole duration
  double size_, energy_unit_, min_energy_;
  std::optional<int> last_points_;
  RunTally tally_;
};

/// Outcome of an experiment with one contact model at one step.
struct Measurement {
  double value;    ///< the experiment's quantity
  double error;    ///< deviation from the value on paper, in the experiment's unit
  RunTally tally;  ///< of all its runs
  std::vector<std::pair<std::string, double>> details =
      {};  ///< by name, as in docs/experiments.schema.json
};

/// A scene, or a few, whose outcome is known on paper.
struct Experiment {
  using StepFunction = std::function<double(double step)>;

  std::string name;       ///< as on the command line: "rolling"
  std::string statement;  ///< what must happen, in one sentence
  std::string quantity;   ///< what is measured, with its unit
  std::string unit;       ///< of the error
  /// Runs the experiment with a step in seconds. Ends early if contacts do not support a pair
  /// (RunTally::unsupported).
  std::function<Measurement(const Simulator& simulator, double step)> run;
  StepFunction expected;  ///< value on paper at a step
  /// Largest error at a step that exact contacts may have, whichever points they consist of: that
  /// of the integrator, the solver, the surface layer and the bisection (experiment_setup.hpp).
  /// Candidates with smaller errors are equal.
  StepFunction resolution;
  bool rests = false;    ///< the value is a motion that must die away
  double radius = 0.25;  ///< of its cylinders, m
};

/// All experiments of a report on candidates, in its order.
const std::vector<Experiment>& all_experiments();

/// Those for the engines' own worlds, in report order: most of all_experiments(), and what users of
/// engines complain about.
const std::vector<const Experiment*>& engine_experiments();

/// Throws InvalidInput (field "experiment") that lists the names there are.
const Experiment& find_experiment(const std::string& name);

// The parts of both, by the question they ask.
std::vector<Experiment> resting_experiments();    ///< does a body at rest stay at rest?
std::vector<Experiment> moving_experiments();     ///< does a moving body obey its law of motion?
std::vector<Experiment> threshold_experiments();  ///< up to which angle, friction, overhang, speed?
std::vector<Experiment> resting_in_engines();
std::vector<Experiment> moving_in_engines();

}  // namespace touchstone
