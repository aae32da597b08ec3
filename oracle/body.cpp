#include "oracle/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace touchstone::oracle {
namespace {

struct Sizes {
  Body& body;

  void operator()(const Cylinder& s) const {
    body.half_extents.z() = s.half_length();
    body.disc_radius = s.radius();
    body.inset = s.rounding();
  }
  void operator()(const Capsule& s) const {
    body.half_extents.z() = s.half_length();
    body.ball_radius = s.radius();
  }
  void operator()(const Sphere& s) const { body.ball_radius = s.radius(); }
  void operator()(const Box& s) const {
    body.half_extents = s.half_extents();
    body.inset = s.rounding();
  }
  void operator()(const Convex& s) const { body.hull = s; }
  void operator()(const Plane&) const {}
};

}  // namespace

Body::Body(const Shape& shape) {
  std::visit(Sizes{*this}, shape);
  ball_radius += rounding_of(shape);
}

// Ericson, "Real-Time Collision Detection", 4.3 and 9.5.
double Body::core_reach(const Vec3& n, const Vec3& from) const {
  if (!hull) {
    return core_half_extents().dot(n.cwiseAbs()) + core_radius() * std::hypot(n.x(), n.y());
  }
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vec3& v : hull->vertices()) farthest = std::max(farthest, (v - from).dot(n));
  return farthest;
}

}  // namespace touchstone::oracle
