#include "aabb.hpp"

#include <cmath>
#include <limits>

namespace touchstone {
namespace {

Aabb around(const Pose& pose, const Vec3& half) {
  return {pose.position() - half, pose.position() + half};
}

}  // namespace

// Half widths are supports along the world's axes (support.hpp).

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
