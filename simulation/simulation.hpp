#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "simulation/scene.hpp"

namespace touchstone {

class ContactModel;

/// The bodies of a scene in motion, whatever moves them: our own world, or an engine's.
class Simulation {
 public:
  /// What the contacts of one step consisted of.
  struct Contacts {
    int points = 0;
    int failures = 0;          ///< answers other than contact or none
    bool unsupported = false;  ///< there is no routine for a pair that occurred
  };

  virtual ~Simulation() = default;
  virtual void step() = 0;
  /// In the order of the scene's bodies.
  virtual const std::vector<BodyState>& states() const = 0;
  virtual Contacts contacts() const = 0;
  /// False once a position or velocity has left `max_in_world` or is not a number; the states then
  /// stay what they last were.
  virtual bool sound() const = 0;
};

/// Begins a simulation of a scene.
using Simulator = std::function<std::unique_ptr<Simulation>(const Scene& scene)>;

/// Simulates in our own world with the contacts of `model`, which must outlive the simulations.
Simulator in_our_world(ContactModel& model);

}  // namespace touchstone
