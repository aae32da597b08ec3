#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/pose.hpp"
#include "reference/shape.hpp"
#include "simulation/mechanism.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {

struct ExactMotion;

/// Bits that say what a shape may touch: what has one of its `meets` among its `types`, or the
/// other way round. MuJoCo's contype and conaffinity.
struct CollisionMask {
  int types = 1, meets = 1;

  bool touches(const CollisionMask& other) const {
    return (types & other.meets) != 0 || (other.types & meets) != 0;
  }
};

/// A collision shape of a link, with every joint in its default position.
struct LinkShape {
  std::string name;  ///< "link/collision", of a world "model::link/collision"
  Shape shape;
  Pose pose;                            ///< in the world; for a robot, in its root link
  std::optional<double> friction = {};  ///< Coulomb's coefficient, where the file gives it
  CollisionMask mask = {};
};

/// Where the mass of a link is.
struct LinkInertia {
  Pose pose;                         ///< of its centre and principal axes, as that of its shapes
  std::optional<Vec3> moments = {};  ///< principal, kg m²; without them, as its shapes have it
};
template <class Archive>
void members(Archive& a, LinkInertia& x) {
  a(x.pose, x.moments);
}

/// A rigid part of a robot or world.
struct Link {
  std::string name;  ///< of a world "model::link"
  Pose pose = {};    ///< of its frame, as that of its shapes
  std::vector<LinkShape> shapes = {};
  std::optional<double> mass = {};          ///< kg, where the file gives it
  std::optional<LinkInertia> inertia = {};  ///< of a link with a mass, where the file gives it
  bool fixed = false;                       ///< to the world
};

/// A joint of two links; its position is zero as the file places them.
struct LinkJoint {
  std::string name;  ///< of a world "model::joint"
  JointKind kind = JointKind::fixed;
  int child = 0, parent = world_body;  ///< indices of links
  Vec3 anchor = Vec3::Zero();          ///< of a hinge: a point of its axis; world frame
  Vec3 axis = Vec3::UnitZ();           ///< world frame, of any length but zero
  double lower = 0, upper = 0;         ///< of the position, rad or m; may be infinite
  std::optional<double> effort = {};   ///< N or N m, where the file gives a positive one
  bool holds = true;                   ///< by a motor; else nothing acts in it
};

/// Collision shapes that are not read.
struct LeftOut {
  std::size_t shapes = 0, unknown = 0;  ///< number; of these, without a known volume
  double volume = 0;                    ///< of the others, m³
};

/// Robot or world of a URDF, SDF or MJCF file.
struct RobotFile {
  std::string name;
  std::vector<Link> links;
  std::vector<LinkJoint> joints;
  std::vector<std::pair<int, int>> apart;  ///< links that the file keeps from touching each other
  bool is_world = false;             ///< its ground is whatever it says; a robot stands on one
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< m/s²
  std::optional<double> step;        ///< s, where the file gives it for use here
  LeftOut left_out;
  /// Elements that were not read, and what was done instead: "collision upper/hull: a mesh".
  std::vector<std::string> ignored;
};

using Folders = std::vector<std::filesystem::path>;

/// Bound on the links of a file, and on its joints.
inline constexpr std::size_t max_links = 2000;

/// Is it the name of a robot or world file (.urdf, .sdf, .world, .mjcf, .xml, .xacro)?
bool is_robot_file(const std::filesystem::path& file);

/// Reads URDF, SDF or MJCF, in a process of its own: whatever a library does to a bad file, nothing
/// of it is seen here but InvalidInput with the element's name. Included models, and meshes, are
/// looked for as `resource_folders` (robot_readers.hpp) says.
RobotFile read_robot(const std::filesystem::path& file, const Folders& folders = {});

/// How a robot or world is simulated.
struct RobotMotion {
  double duration = 2;                                     ///< s
  std::vector<std::pair<std::string, double>> rates = {};  ///< of driven joints, rad/s or m/s
  std::vector<std::string> loose = {};                     ///< joints in which no motor holds
  bool has_fixed_base = false;                             ///< the root link of the robot is held
};

/// Moderate rates that roll a robot's wheels the same way, at the same speed of their rims: of
/// joints with a motor and without limits whose link is round about their axis, which is not
/// upright. In the order of the joints; none of a robot without wheels.
std::vector<std::pair<std::string, double>> rolling_rates(const RobotFile& robot);

/// A scene of the robot, at rest at the start: a body for each shape, fixed joints between those of
/// a link, motors that hold the other joints or drive them; under a robot a ground plane, which it
/// touches with its lowest point. What overlaps at the start never touches. Throws InvalidInput
/// (field "--drive") on an unknown joint, with the nearest names, and (field "--fixed-base") unless
/// there is one base that it could hold.
SceneFile robot_scene(const RobotFile& robot, const RobotMotion& motion);

/// Gives the scene of a robot needs derived from its runs with exact contacts, in the world that it
/// is chosen for: every moving body that touches something overlaps little more than it does there,
/// and what no joint holds ends near where it does there, and as tilted.
void add_robot_needs(SceneFile& file, const ExactMotion& exact);

/// "left out: 1 of 8 collision shapes (volume unknown)"; empty if nothing was.
std::string left_out_text(const RobotFile& robot);

}  // namespace touchstone
