#pragma once

#include <btBulletCollisionCommon.h>
#include <memory>
#include <vector>

#include "simulation/engines/engine_world.hpp"

// Numbers and shapes as Bullet's, in the precision in which it is compiled.
namespace touchstone {

inline btScalar to_scalar(double value) { return static_cast<btScalar>(value); }
inline btVector3 to_vector(const Vec3& v) {
  return {to_scalar(v.x()), to_scalar(v.y()), to_scalar(v.z())};
}
inline Vec3 from_vector(const btVector3& v) { return Vec3(v.x(), v.y(), v.z()); }

inline btTransform to_transform(const Pose& pose) {
  const Eigen::Quaterniond q = pose.unit_orientation();
  return btTransform(
      btQuaternion(to_scalar(q.x()), to_scalar(q.y()), to_scalar(q.z()), to_scalar(q.w())),
      to_vector(pose.position()));
}

/// Shapes as Bullet makes them, with its default margins.
using Made = std::unique_ptr<btCollisionShape>;

struct MakeShape {
  Made operator()(const Cylinder& s) const {
    return std::make_unique<btCylinderShapeZ>(
        to_vector(Vec3(s.radius(), s.radius(), s.half_length())));
  }
  Made operator()(const Plane& s) const {
    return std::make_unique<btStaticPlaneShape>(to_vector(s.unit_normal()),
                                                to_scalar(s.unit_displacement()));
  }
  Made operator()(const Sphere& s) const {
    return std::make_unique<btSphereShape>(to_scalar(s.radius()));
  }
  Made operator()(const Capsule& s) const {
    return std::make_unique<btCapsuleShapeZ>(to_scalar(s.radius()), to_scalar(2 * s.half_length()));
  }
  Made operator()(const Box& s) const {
    return std::make_unique<btBoxShape>(to_vector(s.half_extents()));
  }
};

/// Margin 0: Bullet's default is added outside a hull.
inline Made make_hull(const std::vector<Vec3>& corners) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& corner : corners) hull->addPoint(to_vector(corner), false);
  hull->setMargin(0);
  hull->recalcLocalAabb();
  return hull;
}

inline Made make_shape(const Piece& piece) {
  return piece.corners.empty() ? std::visit(MakeShape{}, piece.shape) : make_hull(piece.corners);
}

}  // namespace touchstone
