#include "support.hpp"

#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// Support functions in the body frame: Ericson, "Real-Time Collision Detection", 4.3 and 9.5.
double local_support(const Cylinder& s, const Vec3& n) {
  return s.half_length() * std::abs(n.z()) + s.radius() * std::hypot(n.x(), n.y());
}
double local_support(const Plane& s, const Vec3& n) {
  return n == s.unit_normal() ? s.unit_displacement() : std::numeric_limits<double>::infinity();
}
double local_support(const Sphere& s, const Vec3&) { return s.radius(); }
double local_support(const Capsule& s, const Vec3& n) {
  return s.half_length() * std::abs(n.z()) + s.radius();
}
double local_support(const Box& s, const Vec3& n) { return s.half_extents().dot(n.cwiseAbs()); }

double centred_support(const Shape& shape, const Pose& pose, const Vec3& n) {
  const Vec3 local = pose.rotation().transpose() * n;
  return std::visit([&](const auto& s) { return local_support(s, local); }, shape);
}

Aabb around(const Pose& pose, const Vec3& half) {
  return {pose.position() - half, pose.position() + half};
}

}  // namespace

double support(const Shape& shape, const Pose& pose, const Vec3& n) {
  return pose.position().dot(n) + centred_support(shape, pose, n);
}

double gap(const Configuration& c, const Vec3& n) {
  // Positions are subtracted first: far from the origin their dot products would cancel.
  return (c.pose_a.position() - c.pose_b.position()).dot(n) - centred_support(c.a, c.pose_a, -n) -
         centred_support(c.b, c.pose_b, n);
}

// Half widths are supports along the world's axes.

Aabb aabb(const Cylinder& shape, const Pose& pose) {
  const Vec3 u = pose.axis();
  Vec3 half;
  for (int i = 0; i < 3; ++i) {
    const double y = u[(i + 1) % 3], z = u[(i + 2) % 3];
    half[i] = shape.half_length() * std::abs(u[i]) + shape.radius() * std::sqrt(y * y + z * z);
  }
  return around(pose, half);
}

Aabb aabb(const Plane& shape, const Pose& pose) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Aabb result{Vec3::Constant(-infinite), Vec3::Constant(infinite)};
  const Vec3 n = pose.rotation() * shape.unit_normal();
  for (int i = 0; i < 3; ++i) {
    if (n[(i + 1) % 3] != 0 || n[(i + 2) % 3] != 0) continue;
    const double offset = shape.unit_displacement();
    (n[i] > 0 ? result.upper[i] = pose.position()[i] + offset
              : result.lower[i] = pose.position()[i] - offset);
  }
  return result;
}

Aabb aabb(const Sphere& shape, const Pose& pose) {
  return around(pose, Vec3::Constant(shape.radius()));
}

Aabb aabb(const Capsule& shape, const Pose& pose) {
  return around(pose,
                shape.half_length() * pose.axis().cwiseAbs() + Vec3::Constant(shape.radius()));
}

Aabb aabb(const Box& shape, const Pose& pose) {
  return around(pose, pose.rotation().cwiseAbs() * shape.half_extents());
}

Aabb aabb(const Shape& shape, const Pose& pose) {
  return std::visit([&](const auto& s) { return aabb(s, pose); }, shape);
}

}  // namespace touchstone
