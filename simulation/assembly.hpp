#pragma once

#include <cstddef>
#include <vector>

#include "simulation/scene.hpp"

namespace touchstone {

/// Bodies that fixed joints make one rigid body; most often a single body, and always where the
/// world holds it. Its frame F has its origin in the centre of mass and its axes along the
/// principal ones: of a single body, its own unless its inertia is given or it is a hull. Of bodies
/// that forces do not move it is that of the driven or the first one.
struct Assembly {
  std::vector<int> bodies;              ///< ascending indices
  bool fixed = false;                   ///< to the world
  int driven = -1;                      ///< the body whose drive moves all of them; −1: none
  Inertia inertia = {0, Vec3::Zero()};  ///< zero unless forces move it
  Pose X_WF = {};                       ///< at the start
  std::vector<Pose> X_FB = {};          ///< by body

  bool is_free() const { return !fixed && driven < 0; }
};

/// The assemblies of a scene that check_scene accepts, in the order of their first bodies.
std::vector<Assembly> assemblies(const Scene& scene);

/// By body: the first of those that joints connect with it, other than through the world; by fixed
/// joints alone if `rigidly`.
std::vector<int> connected(const Scene& scene, bool rigidly);

/// By body: do forces move it? Not if it is fixed or driven, or rigidly joined to what is.
std::vector<bool> moved_by_forces(const Scene& scene);

/// Pose of frame B in frame A, from both in the world.
Pose relative(const Pose& X_WA, const Pose& X_WB);

/// State of the assembly's frame at the start.
BodyState start_of(const Assembly& assembly, const Scene& scene);

/// State of a frame that is at X_FB in a frame with this state, and moves with it.
BodyState state_within(const BodyState& state, const Pose& X_FB);

/// State of a driven body in the step that ends at a time: the pose then, and the mean velocities
/// that lead to it from the pose one step before.
BodyState driven_state(const Drive& drive, const Pose& start, double time, double step);

/// May the two bodies touch? Not if neither is moved by forces, if one of them does not collide, if
/// the scene keeps them apart, if fixed joints make them one, or if these make each of them one
/// with one of two bodies that a joint connects.
class Touching {
 public:
  explicit Touching(const Scene& scene);
  bool operator()(int a, int b) const { return allowed_[a * count_ + b]; }

 private:
  std::size_t count_;
  std::vector<bool> allowed_;
};

}  // namespace touchstone
