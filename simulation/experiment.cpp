#include "simulation/experiment.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "properties/named.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/assembly.hpp"
#include "simulation/experiment_setup.hpp"
#include "simulation/world.hpp"

namespace touchstone {

void RunTally::add(const RunTally& other) {
  steps += other.steps;
  points += other.points;
  flickers += other.flickers;
  single += other.single;
  without += other.without;
  failures += other.failures;
  energy_gained = std::max(energy_gained, other.energy_gained);
  unsupported = unsupported || other.unsupported;
  if (!unsound) unsound = other.unsound;
  last_motion = other.last_motion;
  last_time = other.last_time;
  seconds += other.seconds;
}

namespace {

class OurWorld : public Simulation {
 public:
  OurWorld(const Scene& scene, ContactModel& model) : world_(scene, model) {}
  void step() override { world_.step(); }
  const std::vector<BodyState>& states() const override { return world_.states(); }
  bool sound() const override { return world_.sound(); }
  Contacts contacts() const override {
    Contacts found;
    for (const PairContact& c : world_.contacts()) {
      const ts_status status = c.answer.status;
      if (status == TS_CONTACT) found.points += c.answer.point_count;
      if (status == TS_UNSUPPORTED) found.unsupported = true;
      if (status != TS_CONTACT && status != TS_UNSUPPORTED) ++found.failures;
    }
    return found;
  }

 private:
  World world_;
};

}  // namespace

Simulator in_our_world(ContactModel& model) {
  return [&model](const Scene& scene) { return std::make_unique<OurWorld>(scene, model); };
}

Run::Run(const Scene& scene, const Simulator& simulator, double size)
    : scene_(scene),
      simulation_(simulator(scene)),
      steps_(static_cast<std::uint64_t>(std::llround(scene.duration / scene.step))),
      size_(size),
      energy_unit_(0) {
  for (const Body& body : scene.bodies) {
    inertias_.push_back(body.fixed ? PosedInertia{{0, Vec3::Zero()}} : inertia(body));
    energy_unit_ += inertias_.back().inertia.mass * gravity * size;
  }
  min_energy_ = energy();
}

BodyState Run::at_mass(std::size_t body) const {
  return state_within(states()[body], inertias_[body].X_BC);
}

double Run::kinetic_joules() const {
  double sum = 0;
  for (std::size_t i = 0; i < states().size(); ++i) {
    sum += touchstone::kinetic_energy(at_mass(i), inertias_[i].inertia);
  }
  return sum;
}

double Run::energy() const {
  double potential = 0;
  for (std::size_t i = 0; i < states().size(); ++i) {
    potential -= inertias_[i].inertia.mass * scene_.gravity.dot(at_mass(i).pose.position());
  }
  return kinetic_joules() + potential;
}

bool Run::step() {
  if (tally_.steps >= steps_ || tally_.unsound) return false;
  const auto start = std::chrono::steady_clock::now();
  simulation_->step();
  tally_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++tally_.steps;
  tally_.last_time = time();
  if (!simulation_->sound()) {
    tally_.unsound = time();
    return false;
  }

  const Simulation::Contacts contacts = simulation_->contacts();
  const int points = contacts.points;
  tally_.failures += static_cast<std::uint64_t>(contacts.failures);
  tally_.unsupported = tally_.unsupported || contacts.unsupported;
  tally_.points += static_cast<std::uint64_t>(points);
  if (points == 0) ++tally_.without;
  if (points == 1) ++tally_.single;
  if (last_points_ && *last_points_ != points) ++tally_.flickers;
  last_points_ = points;

  const double now = energy();
  tally_.energy_gained = std::max(tally_.energy_gained, (now - min_energy_) / energy_unit_);
  min_energy_ = std::min(min_energy_, now);
  if (kinetic_energy() > rest_energy(scene_.step, size_)) tally_.last_motion = time();
  return !tally_.unsupported;
}

namespace {

std::vector<Experiment> joined(std::vector<std::vector<Experiment>> parts) {
  std::vector<Experiment> all;
  for (auto& part : parts) {
    for (Experiment& e : part) all.push_back(std::move(e));
  }
  return all;
}

const std::vector<Experiment>& added_for_engines() {
  static const std::vector<Experiment> experiments =
      joined({resting_in_engines(), moving_in_engines()});
  return experiments;
}

}  // namespace

const std::vector<Experiment>& all_experiments() {
  static const std::vector<Experiment> experiments =
      joined({resting_experiments(), moving_experiments(), threshold_experiments()});
  return experiments;
}

const std::vector<const Experiment*>& engine_experiments() {
  static const std::vector<const Experiment*> experiments = [] {
    std::vector<const Experiment*> all;
    for (const Experiment& e : all_experiments()) {
      // How far a body flies in a step is no question of contacts that a solver may look ahead for.
      if (e.name != "tunnelling") all.push_back(&e);
    }
    for (const Experiment& e : added_for_engines()) all.push_back(&e);
    return all;
  }();
  return experiments;
}

const Experiment& find_experiment(const std::string& name) {
  static const std::vector<Experiment> known = joined({all_experiments(), added_for_engines()});
  return named(known, name, "experiment");
}

}  // namespace touchstone
