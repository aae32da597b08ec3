#pragma once

#include <array>
#include <memory>
#include <vector>

#include "candidates/candidate.h"
#include "reference/invalid_input.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/scene.hpp"

// What the modules touchstone-world-NAME.so share with the program. Each holds one engine and is
// loaded in a process of its own alone (run_engines.hpp), for the engine may crash or hang, and two
// precisions of Bullet have the same symbols.
namespace touchstone {

/// A scene in an engine's own world, which finds the contacts, solves and moves the bodies.
class EngineWorld : public Simulation {
 public:
  const std::vector<BodyState>& states() const override { return states_; }
  bool sound() const override { return sound_; }

 protected:
  explicit EngineWorld(const Scene& scene) : scene_(scene) {
    for (const Body& b : scene.bodies) states_.push_back({b.pose, b.velocity, b.angular_velocity});
  }

  /// Reads one body's state from the engine; `orientation` is w, x, y, z.
  void set_state(std::size_t body, const Vec3& position, const std::array<double, 4>& orientation,
                 const Vec3& velocity, const Vec3& angular_velocity) {
    for (const Vec3& v : {position, velocity, angular_velocity}) {
      if (!(v.norm() < max_in_world)) sound_ = false;
    }
    if (!sound_) return;
    try {
      const auto& [w, x, y, z] = orientation;
      states_[body] = {Pose(position, Eigen::Quaterniond(w, x, y, z)), velocity, angular_velocity};
    } catch (const InvalidInput&) {  // not a number
      sound_ = false;
    }
  }

  const Scene scene_;

 private:
  std::vector<BodyState> states_;
  bool sound_ = true;
};

/// What a module exports by its function `touchstone_engine`.
struct EngineModule {
  const char* version;        ///< of the engine
  const char* settings;       ///< of its world: how its shapes are made, its solver's defaults
  const char* best_settings;  ///< what differs with its solver at its best
  /// Begins a scene, which has passed check_scene.
  std::unique_ptr<Simulation> (*begin)(const Scene& scene, const EngineSetup& setup);
};

}  // namespace touchstone

extern "C" TOUCHSTONE_EXPORT const touchstone::EngineModule* touchstone_engine();
