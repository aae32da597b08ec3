#include "simulation/motion.hpp"

#include <numbers>

namespace touchstone {
namespace {

using std::numbers::pi;

struct OfShape {
  double density;

  Inertia operator()(const Plane&) const { return {0, Vec3::Zero()}; }
  Inertia operator()(const Sphere& s) const {
    const double r2 = s.radius() * s.radius(), mass = density * 4 / 3 * pi * r2 * s.radius();
    return {mass, Vec3::Constant(0.4 * mass * r2)};
  }
  Inertia operator()(const Cylinder& s) const {
    const double r2 = s.radius() * s.radius(), h = s.half_length();
    const double mass = density * 2 * pi * r2 * h, across = mass * (r2 / 4 + h * h / 3);
    return {mass, Vec3(across, across, mass * r2 / 2)};
  }
  /// A cylinder and two half balls, whose centres of mass lie 3/8 of the radius beyond its ends.
  Inertia operator()(const Capsule& s) const {
    const double r = s.radius(), h = s.half_length();
    const Inertia side = (*this)(Cylinder(r, h)), ball = (*this)(Sphere(r));
    const double across =
        side.principal.x() + ball.principal.x() + ball.mass * (h * h + 0.75 * r * h);
    return {side.mass + ball.mass, Vec3(across, across, side.principal.z() + ball.principal.z())};
  }
  Inertia operator()(const Box& s) const {
    const Vec3 h = s.half_extents(), squared = h.cwiseProduct(h);
    const double mass = density * 8 * h.prod();
    return {mass, mass / 3 * (Vec3::Constant(squared.sum()) - squared)};
  }
};

/// I v in the world frame.
Vec3 times(const BodyState& state, const Inertia& inertia, const Vec3& v) {
  const Eigen::Matrix3d& r = state.pose.rotation();
  return r * inertia.principal.cwiseProduct(r.transpose() * v);
}

}  // namespace

Inertia inertia(const Shape& shape, double density) { return std::visit(OfShape{density}, shape); }

double kinetic_energy(const BodyState& state, const Inertia& inertia) {
  return (inertia.mass * state.velocity.squaredNorm() +
          state.angular_velocity.dot(spin(state, inertia))) /
         2;
}

Vec3 spin(const BodyState& state, const Inertia& inertia) {
  return times(state, inertia, state.angular_velocity);
}

Vec3 free_angular_velocity(const BodyState& state, const Inertia& inertia, double step) {
  constexpr int iterations = 5;  // each gains the digits of one angle of a step
  const Vec3 momentum = spin(state, inertia);
  Vec3 next = state.angular_velocity;
  for (int i = 0; i < iterations; ++i) {
    const double angle = step * next.norm();
    if (angle == 0) break;
    const Eigen::Matrix3d turned =
        Eigen::AngleAxisd(angle, next.normalized()) * state.pose.rotation();
    next = turned * (turned.transpose() * momentum).cwiseQuotient(inertia.principal);
  }
  return next;
}

Vec3 torque(const BodyState& state, const Inertia& inertia, const Vec3& change, double step) {
  return times(state, inertia, change) / step;
}

}  // namespace touchstone
