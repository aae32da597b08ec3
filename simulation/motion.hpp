#pragma once

#include "reference/pose.hpp"
#include "reference/shape.hpp"

namespace touchstone {

/// Of a solid body of even density, about its centre.
struct Inertia {
  double mass;     ///< kg
  Vec3 principal;  ///< kg m², about the shape's own axes
};

/// Closed forms of the solid shapes. A plane has none: zeros.
Inertia inertia(const Shape& shape, double density);

/// How a body lies and moves.
struct BodyState {
  Pose pose;
  Vec3 velocity, angular_velocity;  ///< of the centre, world frame; m/s, rad/s
};

double kinetic_energy(const BodyState& state, const Inertia& inertia);  ///< J

/// The angular velocity of a body with this angular momentum about its centre.
Vec3 angular_velocity(const Pose& pose, const Inertia& inertia, const Vec3& spin);
/// Its mean over a step without torque: the angular momentum stays, and the angular velocity is
/// that at the orientation half way (implicit midpoint rule, of second order).
Vec3 free_angular_velocity(const Pose& pose, const Inertia& inertia, const Vec3& spin, double step);
/// The angular momentum of an angular velocity.
Vec3 spin_of(const Pose& pose, const Inertia& inertia, const Vec3& angular_velocity);

}  // namespace touchstone
