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
Vec3 spin(const BodyState& state, const Inertia& inertia);  ///< angular momentum about the centre

/// The angular velocity after a step without torque. The angular momentum L stays, and the angular
/// velocity turns with the body: ω' = R' I⁻¹ R'ᵀ L, where R' is the body turned by ω' for a step.
Vec3 free_angular_velocity(const BodyState& state, const Inertia& inertia, double step);
/// The torque that changes the angular velocity by so much in a step, the body being as it is.
Vec3 torque(const BodyState& state, const Inertia& inertia, const Vec3& change, double step);

}  // namespace touchstone
