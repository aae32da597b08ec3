#pragma once

#include <ode/ode.h>

#include "simulation/assembly.hpp"

// The bodies and joints of a scene in a world of ODE, whoever finds the contacts.

namespace touchstone {

/// Orientation of a pose as ODE's quaternion.
struct OdeQuaternion {
  explicit OdeQuaternion(const Pose& pose);
  dQuaternion wxyz;
};

/// Body of an assembly, at rest at the origin; kinematic if the assembly is driven, null if it is
/// fixed.
dBodyID make_ode_body(dWorldID world, const Assembly& assembly);

/// Geometry of a body that follows `moving`, at X_FB in its frame, or stays at the body's pose if
/// that is null. A plane is made in world coordinates: ODE's have no pose.
dGeomID make_ode_geom(dSpaceID space, const Body& body, dBodyID moving, const Pose& X_FB);

/// Joint of two bodies at their initial poses, of which one may be null; null if both are, or if
/// the joint is fixed, which assemblies obey.
dJointID make_ode_joint(dWorldID world, const Joint& joint, dBodyID a, dBodyID b);

/// Sets the rate and force of a joint's motor, if it has one, for the step that begins at a time. A
/// motor that holds a position follows it at the position's own rate and corrects a fifth of the
/// error in a step, as contacts do.
void run_motor(dJointID made, const Joint& joint, double time, double step);

void place(dBodyID body, const BodyState& state);
/// Throws InvalidInput unless all of it are numbers.
BodyState state_of(dBodyID body);

}  // namespace touchstone
