#pragma once

#include <string>
#include <vector>

#include "reference/pose.hpp"
#include "reference/shape.hpp"

namespace touchstone {

/// Of two bodies in contact, friction is the geometric mean and restitution the larger one.
struct Material {
  double friction = 0.5;   ///< Coulomb's coefficient
  double restitution = 0;  ///< speed after a bounce over speed before it, 0 … 1
};

/// A rigid body and how it starts. Velocities are those of the centre, in the world frame.
struct Body {
  std::string name;
  Shape shape;
  double density = 1000;  ///< kg/m³; of a fixed body it does not matter
  Material material = {};
  Pose pose = {};
  Vec3 velocity = Vec3::Zero();          ///< m/s
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s
  bool fixed = false;                    ///< moves for nobody; a plane must be fixed
};

struct Scene {
  std::vector<Body> bodies;
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< m/s²
  double step = 1.0 / 240;           ///< s
  double duration = 1;               ///< s
  /// Metres that resting bodies may overlap by: only what is deeper is pushed apart.
  double surface_layer = 1e-4;
  int solver_iterations = 100;  ///< of ODE's solver in a step; stacks need more
};

/// Metres, m/s, rad/s, m/s²: a world in which anything is larger is no longer simulated.
inline constexpr double max_in_world = 1e6;

/// Throws InvalidInput with the path of the field ("bodies[2].density") unless the scene can be
/// simulated: ODE ends the process where a product of what it was given overflows or vanishes.
void check_scene(const Scene& scene);

}  // namespace touchstone
