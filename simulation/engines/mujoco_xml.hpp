#pragma once

#include <string>

#include "simulation/engines/engine_world.hpp"
#include "simulation/kinematic_tree.hpp"

namespace touchstone {

/// A scene as MuJoCo reads it. Assembly i is the body "b<i>", a hinge or slider j the joint "j<j>",
/// and its motor the actuator of that name; a geom's user data are the index of its body in the
/// scene.
///
/// A free or driven assembly has a freejoint, unless it hangs on another one or the world: then it
/// is nested, and its joint's position is that of the scene's joint. A driven one is so heavy that
/// no contact stops it, and its inertia is that of a ball.
std::string mujoco_xml(const Scene& scene, const std::vector<Assembly>& assemblies,
                       const std::vector<Hanging>& tree, const EngineSetup& setup);

}  // namespace touchstone
