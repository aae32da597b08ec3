#pragma once

#include <ode/ode.h>

#include "simulation/motion.hpp"
#include "simulation/scene.hpp"

namespace touchstone {

// Bodies as ODE has them.

/// Starts ODE, once.
void initialise_ode();

/// A moving body with its pose, velocities and mass.
dBodyID make_ode_body(dWorldID world, const Body& body, const Inertia& inertia);

/// What ODE's own routines see: it follows `moving`, or stays where the body is if that is null.
/// Null for a cylinder, whose contacts ODE does not find here.
dGeomID make_ode_geom(const Body& body, dBodyID moving);

/// As it is now.
BodyState state_of(dBodyID body);

}  // namespace touchstone
