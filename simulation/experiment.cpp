#include "simulation/experiment.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "properties/named.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/experiment_setup.hpp"

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
  seconds += other.seconds;
}

Run::Run(const Scene& scene, ContactModel& model, double size)
    : world_(scene, model),
      steps_(static_cast<std::uint64_t>(std::llround(scene.duration / scene.step))),
      energy_unit_(0),
      min_energy_(energy()) {
  for (const Body& body : scene.bodies) {
    if (!body.fixed) energy_unit_ += inertia(body.shape, body.density).mass * gravity * size;
  }
}

bool Run::step() {
  if (tally_.steps >= steps_ || tally_.unsound) return false;
  const auto start = std::chrono::steady_clock::now();
  world_.step();
  tally_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++tally_.steps;
  if (!world_.sound()) {
    tally_.unsound = world_.time();
    return false;
  }

  int points = 0;
  for (const PairContact& c : world_.contacts()) {
    const ts_status status = c.answer.status;
    if (status == TS_CONTACT) points += c.answer.point_count;
    if (status == TS_UNSUPPORTED) tally_.unsupported = true;
    if (status != TS_CONTACT && status != TS_UNSUPPORTED) ++tally_.failures;
  }
  tally_.points += static_cast<std::uint64_t>(points);
  if (points == 0) ++tally_.without;
  if (points == 1) ++tally_.single;
  if (last_points_ && *last_points_ != points) ++tally_.flickers;
  last_points_ = points;

  const double now = energy();
  tally_.energy_gained = std::max(tally_.energy_gained, (now - min_energy_) / energy_unit_);
  min_energy_ = std::min(min_energy_, now);
  return !tally_.unsupported;
}

const std::vector<Experiment>& all_experiments() {
  static const std::vector<Experiment> experiments = [] {
    std::vector<Experiment> all;
    for (auto part : {resting_experiments(), moving_experiments(), threshold_experiments()}) {
      for (Experiment& e : part) all.push_back(std::move(e));
    }
    return all;
  }();
  return experiments;
}

const Experiment& find_experiment(const std::string& name) {
  return named(all_experiments(), name, "experiment");
}

}  // namespace touchstone
