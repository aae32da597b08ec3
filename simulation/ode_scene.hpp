#pragma once

#include <memory>
#include <ode/ode.h>
#include <vector>

#include "candidates/ode_mesh.hpp"
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

/// Hulls and floors as meshes of triangles, for ODE's convex geoms end the process where two of
/// them touch. Must outlive their geoms.
using OdeMeshes = std::vector<std::unique_ptr<OdeMesh>>;

/// Geometry at a pose in the frame of `moving`, or in the world if that is null. A plane is made in
/// world coordinates: ODE's have no pose.
dGeomID make_ode_geom(dSpaceID space, const Shape& shape, dBodyID moving, const Pose& pose,
                      OdeMeshes& meshes);

/// A hinge or slider of two bodies at their initial poses, of which one may be null. ODE knows the
/// angle of a hinge within a turn, and its stops must lie there; this one counts the turns.
class OdeJoint {
 public:
  OdeJoint(dWorldID world, const Joint& joint, dBodyID a, dBodyID b);

  /// Sets the stops and the motor for the step that begins at a time.
  void prepare(double time, double step);
  /// Takes note of how far the bodies have turned; called after the step.
  void follow(double step);

 private:
  void set_hinge_stops(double turns);

  Joint joint_;
  dJointID made_;
  double position_ = 0;  ///< rad or m; once followed, where the step should have led
};

/// Gives a contact the materials of its bodies: the geometric mean of their friction, Coulomb's as
/// a pyramid, and the larger restitution.
void set_materials(dContact& contact, const Material& a, const Material& b);

/// Lets the surface of a contact's first body move along that of the second at a velocity, as a
/// belt does. The contact has its fdir1. If ODE's first body of the joint is null, the second
/// stands in for it, with the normal turned round.
void set_belt(dContact& contact, const Vec3& belt, bool is_first_null);

void place(dBodyID body, const BodyState& state);
/// Throws InvalidInput unless all of it are numbers.
BodyState state_of(dBodyID body);

}  // namespace touchstone
