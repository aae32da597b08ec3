#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "pose.hpp"
#include "shape.hpp"

namespace touchstone {

// Bodies in one frame, which has the world's axes and its origin at B's centre: positions are
// subtracted before anything else, so that they keep their digits far from the world's origin.

struct PosedCylinder {
  Vec3 centre, axis;
  double radius, half_length;
  const Eigen::Matrix3d& axes;
};
struct PosedSphere {
  Vec3 centre;
  double radius;
};
struct PosedCapsule {
  Vec3 centre, axis;
  double radius, half_length;
};
struct PosedBox {
  Vec3 centre;
  const Eigen::Matrix3d& axes;
  Vec3 half_extents;
};

inline PosedCylinder posed(const Cylinder& s, const Pose& pose, const Vec3& origin) {
  return {pose.position() - origin, pose.axis(), s.radius(), s.half_length(), pose.rotation()};
}
inline PosedSphere posed(const Sphere& s, const Pose& pose, const Vec3& origin) {
  return {pose.position() - origin, s.radius()};
}
inline PosedCapsule posed(const Capsule& s, const Pose& pose, const Vec3& origin) {
  return {pose.position() - origin, pose.axis(), s.radius(), s.half_length()};
}
inline PosedBox posed(const Box& s, const Pose& pose, const Vec3& origin) {
  return {pose.position() - origin, pose.rotation(), s.half_extents()};
}

/// max over the body of (x − centre)·n for a unit n.
inline double reach(const PosedCylinder& s, const Vec3& n) {
  return s.half_length * std::abs(s.axis.dot(n)) + s.radius * s.axis.cross(n).norm();
}
inline double reach(const PosedSphere& s, const Vec3&) { return s.radius; }
inline double reach(const PosedCapsule& s, const Vec3& n) {
  return s.half_length * std::abs(s.axis.dot(n)) + s.radius;
}
inline double reach(const PosedBox& s, const Vec3& n) {
  return s.half_extents.dot((s.axes.transpose() * n).cwiseAbs());
}

}  // namespace touchstone
