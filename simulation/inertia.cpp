#include "simulation/inertia.hpp"

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

}  // namespace

Inertia inertia(const Shape& shape, double density) { return std::visit(OfShape{density}, shape); }

}  // namespace touchstone
