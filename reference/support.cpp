#include "support.hpp"

#include <algorithm>
#include <limits>

#include "posed_body.hpp"

namespace touchstone {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The support of the body as if its position were the origin.
template <class Bounded>
double centred_support(const Bounded& s, const Pose& pose, const Vec3& n) {
  return reach(posed(s, pose, Vec3::Zero()), n) + rounding_in(s);
}
double centred_support(const Plane& s, const Pose& pose, const Vec3& n) {
  const Vec3 local = pose.rotation().transpose() * n;
  return local == s.unit_normal() ? s.unit_displacement() : infinite;
}
double centred_support(const Shape& shape, const Pose& pose, const Vec3& n) {
  return std::visit([&](const auto& s) { return centred_support(s, pose, n); }, shape);
}

/// Half widths are supports along the world's axes.
template <class Bounded>
Aabb around(const Bounded& s, const Pose& pose) {
  Vec3 half;
  for (int i = 0; i < 3; ++i) half[i] = centred_support(s, pose, Vec3::Unit(i));
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

Aabb aabb(const Cylinder& shape, const Pose& pose) { return around(shape, pose); }
Aabb aabb(const Sphere& shape, const Pose& pose) { return around(shape, pose); }
Aabb aabb(const Capsule& shape, const Pose& pose) { return around(shape, pose); }
Aabb aabb(const Box& shape, const Pose& pose) { return around(shape, pose); }
Aabb aabb(const Convex& shape, const Pose& pose) {
  Aabb result;
  for (int i = 0; i < 3; ++i) {
    result.lower[i] = pose.position()[i] - centred_support(shape, pose, -Vec3::Unit(i));
    result.upper[i] = pose.position()[i] + centred_support(shape, pose, Vec3::Unit(i));
  }
  return result;
}
Aabb aabb(const Plane& shape, const Pose& pose) {
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
Aabb aabb(const Shape& shape, const Pose& pose) {
  return std::visit([&](const auto& s) { return aabb(s, pose); }, shape);
}

}  // namespace touchstone
