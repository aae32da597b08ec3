#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/pose.hpp"
#include "reference/shape.hpp"
#include "simulation/mechanism.hpp"

namespace touchstone {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Surface of a body. A contact takes the geometric mean of both bodies' friction and the larger
/// restitution.
struct Material {
  double friction = 0.5;   ///< Coulomb's coefficient
  double restitution = 0;  ///< ratio of the speeds after and before a bounce, 0 … 1
};

/// Mass properties of a body about its centre of mass.
struct Inertia {
  double mass;     ///< kg
  Vec3 principal;  ///< principal moments, kg m²
};

/// Mass properties with the frame in which they are: origin in the centre of mass, axes along the
/// principal ones.
struct PosedInertia {
  Inertia inertia;
  Pose X_BC = {};  ///< of that frame, in the body's frame
};

/// A rigid body and its initial state. Its centre is the origin of its shape's frame, wherever its
/// mass is.
/// Velocities: of the centre, world frame.
struct Body {
  std::string name;
  Shape shape;
  double density = 1000;  ///< kg/m³; irrelevant if fixed or if the inertia is given
  Material material = {};
  Pose pose = {};
  Vec3 velocity = Vec3::Zero();          ///< m/s
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s
  bool fixed = false;                    ///< immovable; a plane must be
  std::optional<Drive> drive = {};       ///< instead of forces; the body is not fixed then
  /// Velocity of the surface in the body's own frame, m/s, as that of a conveyor's belt; its part
  /// along the contact normal has no effect.
  Vec3 surface_velocity = Vec3::Zero();
  bool collides = true;  ///< false: it has mass, but touches nothing
  /// Instead of that of the shape at its density. All of it may be zero where a fixed joint makes
  /// the body one with others that have mass.
  std::optional<PosedInertia> inertia = {};
  /// Of a fixed box: where an engine's own world finds the contacts, each face consists of so many
  /// squares of two triangles along a side (candidates/floor.hpp). 0: it is a box there, too.
  int squares = 0;

  /// Do forces move it?
  bool is_free() const { return !fixed && !drive; }
};

/// Bodies under gravity, what else moves them, and the settings of the solver.
struct Scene {
  std::vector<Body> bodies;
  std::vector<Joint> joints = {};
  std::vector<Push> pushes = {};
  std::vector<std::pair<int, int>> apart = {};  ///< bodies that never touch each other
  Vec3 gravity = Vec3(0, 0, -9.81);             ///< m/s²
  double step = 1.0 / 240;                      ///< s
  double duration = 1;                          ///< s
  /// Depth that the solver tolerates, metres: only deeper contacts are pushed apart.
  double surface_layer = 1e-4;
  int solver_iterations = 100;  ///< of ODE's solver, per step; stacks need more
};

/// Bound on positions, speeds, angular speeds and gravity (m, m/s, rad/s, m/s²); a motion beyond it
/// is no longer simulated.
inline constexpr double max_in_world = 1e6;
/// Densities of bodies that forces move, kg/m³.
inline constexpr double min_density = 1e-6, max_density = 1e9;
inline constexpr double max_friction = 1e6;  ///< Coulomb's coefficient

/// Throws InvalidInput with the path of the field ("bodies[2].density") unless the scene can be
/// simulated: ODE ends the process where a product of its inputs overflows or vanishes.
void check_scene(const Scene& scene);

/// Inertia of a solid shape of uniform density, in closed form; zeros for a plane and a flat hull.
/// Its frame is the shape's own, but for a hull, of which the mass may lie anywhere.
PosedInertia inertia(const Shape& shape, double density);

/// A body's inertia: the given one, or that of its shape at its density.
PosedInertia inertia(const Body& body);

/// A mass with these moments and products of inertia about axes through its centre, as lies in the
/// frame to which these are parallel.
PosedInertia along_principal_axes(double mass, const Vec3& centre, const Eigen::Matrix3d& moments);

/// Why no body has these principal moments, as "not positive"; null if there can be one. The
/// largest may exceed the sum of the others (triangle inequality) by a rounding to two digits.
const char* impossible(const Vec3& principal);

/// Pose and velocities of a body at one time.
struct BodyState {
  Pose pose;
  Vec3 velocity, angular_velocity;  ///< of the centre, world frame; m/s, rad/s
};
/// Joules.
double kinetic_energy(const BodyState& state, const Inertia& inertia);

// Spin: angular momentum about the body's centre, world frame, kg m²/s.

Vec3 spin(const Pose& pose, const Inertia& inertia, const Vec3& angular_velocity);
Vec3 angular_velocity(const Pose& pose, const Inertia& inertia, const Vec3& spin);

/// Mean angular velocity over a step without torque: the spin is constant, and the
/// angular velocity is evaluated at the orientation half way (implicit midpoint rule, second
/// order).
Vec3 free_angular_velocity(const Pose& pose, const Inertia& inertia, const Vec3& spin, double step);

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

}  // namespace touchstone
