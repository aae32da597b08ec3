#pragma once

#include <array>
#include <memory>
#include <vector>

#include "candidates/candidate.h"
#include "candidates/floor.hpp"
#include "simulation/assembly.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/scene.hpp"

// What the modules touchstone-world-NAME.so share with the program. Each holds one engine and is
// loaded in a process of its own alone (run_engines.hpp), for the engine may crash or hang, and two
// precisions of Bullet have the same symbols.
namespace touchstone {

/// A part of what stands for a body in an engine.
struct Piece {
  Shape shape;
  Vec3 centre = Vec3::Zero();      ///< in the body's frame
  std::vector<Vec3> corners = {};  ///< of a hull, be the shape convex or what the hull replaces
  int squares = 0;                 ///< of a box: of its floor of triangles (Body)

  /// The floor of triangles that stands for the box.
  Floor floor() const { return {std::get<Box>(shape).half_extents(), squares}; }
};

/// What stands for a body: its own shape, or what replaces a cylinder or a box.
std::vector<Piece> pieces(const Body& body, const EngineShape& engine_shape);

/// Pose of what is at a point, and not turned, in a frame with a pose.
inline Pose shifted(const Pose& pose, const Vec3& point) {
  return {pose.position() + pose.rotation() * point, pose.orientation()};
}

/// A scene in an engine's own world, which finds the contacts, solves and moves the bodies. Each
/// assembly is one body of the engine. What the engine has to do for one is by index in
/// `assemblies_`.
class EngineWorld : public Simulation {
 public:
  void step() final;
  const std::vector<BodyState>& states() const override { return states_; }
  bool sound() const override { return sound_; }

 protected:
  EngineWorld(const Scene& scene, EngineSetup setup);

  /// Steps the engine and reads its states with set_state; only free assemblies need one.
  virtual void advance() = 0;
  /// Before a step: a driven assembly's pose and its velocities in the step, and the pose after it.
  virtual void drive(std::size_t assembly, const BodyState& state, const Pose& after) = 0;
  /// Before a step: applies a force at a free assembly's centre of mass, and a torque, for it.
  virtual void push(std::size_t assembly, const Vec3& force, const Vec3& torque) = 0;
  /// Before a step: sets the motor and the stops of a hinge or slider, by index in the scene, for
  /// the step that begins at a time.
  virtual void prepare_joint(std::size_t joint, double time) = 0;

  /// Index of a body's assembly, by index in the scene.
  std::size_t assembly_of(int body) const { return assembly_of_[body]; }
  /// State of an assembly at the start.
  BodyState start_of(std::size_t assembly) const {
    return touchstone::start_of(assemblies_[assembly], scene_);
  }
  std::vector<Piece> pieces(int body) const {
    return touchstone::pieces(scene_.bodies[body], setup_.shape_of(body));
  }
  /// Velocity of the surface of a body along that of another one in a contact, across its normal.
  Vec3 belt(int body, int other, const Vec3& normal) const;

  bool is_no_margin(std::size_t body) const {
    return setup_.shape_of(body).kind == EngineShape::Kind::no_margin;
  }
  bool is_cured() const { return setup_.is_cured(); }
  bool is_multipoint() const { return setup_.has(EngineShape::Kind::multipoint); }

  /// Reads the state of an assembly from the engine; `orientation` is w, x, y, z.
  void set_state(std::size_t assembly, const Vec3& position,
                 const std::array<double, 4>& orientation, const Vec3& velocity,
                 const Vec3& angular_velocity);

  const Scene scene_;
  const EngineSetup setup_;
  const std::vector<Assembly> assemblies_;
  const Touching may_touch_;

 private:
  void place_bodies(std::size_t assembly, const BodyState& state);
  const Body& driving(const Assembly& assembly) const { return scene_.bodies[assembly.driven]; }

  int steps_ = 0;
  std::vector<std::size_t> assembly_of_;  ///< by body
  std::vector<Vec3> centres_;             ///< by assembly: its origin
  std::vector<BodyState> states_;         ///< by body
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
