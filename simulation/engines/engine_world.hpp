#pragma once

#include <array>
#include <memory>
#include <vector>

#include "candidates/candidate.h"
#include "candidates/model.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/assembly.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/scene.hpp"

// What the modules touchstone-world-NAME.so share with the program. Each holds one engine and is
// loaded in a process of its own alone (run_engines.hpp), for the engine may crash or hang, and two
// precisions of Bullet have the same symbols.
namespace touchstone {

/// A scene in an engine's own world, which finds the contacts, solves and moves the bodies.
class EngineWorld : public Simulation {
 public:
  void step() final {
    const double begin = scene_.step * steps_, middle = begin + scene_.step / 2;
    const double end = scene_.step * ++steps_;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Body& body = scene_.bodies[i];
      if (!body.drive) continue;
      const BodyState after = driven_state(*body.drive, body.pose, end, scene_.step);
      drive(i, {driven_pose(*body.drive, body.pose, begin), after.velocity, after.angular_velocity},
            after.pose);
    }
    for (const Push& p : scene_.pushes) {
      if (p.from <= middle && middle < p.until) push(static_cast<std::size_t>(p.body), p);
    }
    advance();
    for (std::size_t i = 0; i < states_.size() && sound_; ++i) {
      const Body& body = scene_.bodies[i];
      if (body.drive) states_[i] = driven_state(*body.drive, body.pose, end, scene_.step);
    }
  }
  const std::vector<BodyState>& states() const override { return states_; }
  bool sound() const override { return sound_; }

 protected:
  EngineWorld(const Scene& scene, EngineSetup setup) : scene_(scene), setup_(std::move(setup)) {
    for (const Body& b : scene.bodies) states_.push_back({b.pose, b.velocity, b.angular_velocity});
  }

  /// Steps the engine and reads its states with set_state; driven bodies do not need one.
  virtual void advance() = 0;
  /// Before a step: a driven body's pose and its velocities in the step, and the pose after it.
  virtual void drive(std::size_t body, const BodyState& state, const Pose& after) = 0;
  /// Before a step: applies force and torque for it.
  virtual void push(std::size_t body, const Push& push) = 0;

  /// What stands for a cylinder instead of the engine's own, in the body's frame; empty where that
  /// is used as it is. A capsule lies along z. A box is the core of one part.
  std::vector<RoundedPolytope> parts(std::size_t body) const {
    const auto* c = std::get_if<Cylinder>(&scene_.bodies[body].shape);
    if (!c) return {};
    const auto [kind, count] = setup_.shape_of(body);
    std::vector<RoundedPolytope> result;
    using Kind = EngineShape::Kind;
    if (kind == Kind::capsule) result = inscribed_capsule(c->radius(), c->half_length());
    if (kind == Kind::spheres) result = inscribed_spheres(count, c->radius(), c->half_length());
    if (kind == Kind::hull) result = inscribed_prism(count, c->radius(), c->half_length());
    for (RoundedPolytope& part : result) part.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
    return result;
  }
  /// The shape of a body, with the box where that stands for a cylinder.
  Shape shape(std::size_t body) const {
    const Shape& shape = scene_.bodies[body].shape;
    const auto* c = std::get_if<Cylinder>(&shape);
    if (!c || setup_.shape_of(body).kind != EngineShape::Kind::box) return shape;
    return Box(Vec3(c->radius(), c->radius(), c->half_length()));
  }
  bool is_no_margin(std::size_t body) const {
    return setup_.shape_of(body).kind == EngineShape::Kind::no_margin;
  }
  bool is_cured() const { return setup_.cured || setup_.has(EngineShape::Kind::exact); }
  bool is_multipoint() const { return setup_.has(EngineShape::Kind::multipoint); }

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
  const EngineSetup setup_;

 private:
  int steps_ = 0;
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
