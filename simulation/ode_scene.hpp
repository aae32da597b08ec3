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

/// Geometry at a pose in the frame of `moving`, or in the world if that is null. A plane is made in
/// world coordinates: ODE's have no pose.
dGeomID make_ode_geom(dSpaceID space, const Shape& shape, dBodyID moving, const Pose& pose);

/// Joint of two bodies at their initial poses, of which one may be null; null if it is fixed, which
/// assemblies obey.
dJointID make_ode_joint(dWorldID world, const Joint& joint, dBodyID a, dBodyID b);

/// Sets the rate and force of a joint's motor, if it has one, for the step that begins at a time.
void run_motor(dJointID made, const Joint& joint, double time, double step);

/// Lets the surface of a contact's first body move along that of the second at a velocity, as a
/// belt does. The contact has its fdir1. If ODE's first body of the joint is null, the second
/// stands in for it, with the normal turned round.
void set_belt(dContact& contact, const Vec3& belt, bool is_first_null);

void place(dBodyID body, const BodyState& state);
/// Throws InvalidInput unless all of it are numbers.
BodyState state_of(dBodyID body);

}  // namespace touchstone
