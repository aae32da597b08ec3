#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "convex_tables.hpp"
#include "pose.hpp"
#include "shape.hpp"

namespace touchstone {

// Bodies in one frame, which has the world's axes and its origin in one of them (pair.hpp):
// positions are subtracted before anything else, so that they keep their digits far from the
// world's origin.

struct PosedCylinder {
  Vec3 centre;
  double radius, half_length;
  const Eigen::Matrix3d& axes;

  /// A view of the pose's own column: a copy would be stored and loaded again in other pieces, for
  /// which the processor waits.
  auto axis() const { return axes.col(2); }
};
/// The half-space normal·(x − centre) <= displacement.
struct PosedPlane {
  Vec3 centre, normal;
  double displacement;
};
struct PosedSphere {
  Vec3 centre;
  double radius;
};
struct PosedCapsule {
  Vec3 centre;
  double radius, half_length;
  const Eigen::Matrix3d& axes;

  auto axis() const { return axes.col(2); }
};
struct PosedBox {
  Vec3 centre;
  const Eigen::Matrix3d& axes;
  Vec3 half_extents;
};

struct PosedConvex {
  Vec3 centre;  ///< the origin of the body's frame, which may be far from its vertices
  const Eigen::Matrix3d& axes;
  const Convex& body;
};

// A rounded body is posed as its core (pair.hpp adds the rounding to the answers), without a
// branch: it would keep the cheapest pairs' numbers out of registers.

/// Of any shape.
inline double rounding_in(const auto& s) {
  if constexpr (requires { s.rounding(); }) return s.rounding();
  return 0;
}

inline PosedCylinder posed(const Cylinder& s, const Pose& pose, const auto& centre) {
  return {centre, s.positive_core_radius(), s.positive_core_half_length(), pose.rotation()};
}
inline PosedPlane posed(const Plane& s, const Pose& pose, const auto& centre) {
  return {centre, pose.rotation() * s.unit_normal(), s.unit_displacement()};
}
inline PosedSphere posed(const Sphere& s, const Pose&, const auto& centre) {
  return {centre, s.radius()};
}
inline PosedCapsule posed(const Capsule& s, const Pose& pose, const auto& centre) {
  return {centre, s.radius(), s.half_length(), pose.rotation()};
}
inline PosedBox posed(const Box& s, const Pose& pose, const auto& centre) {
  return {centre, pose.rotation(), s.positive_core_half_extents()};
}
inline PosedConvex posed(const Convex& s, const Pose& pose, const auto& centre) {
  return {centre, pose.rotation(), s};
}

/// max over the body of (x − centre)·n for a unit n.
inline double reach(const PosedCylinder& s, const Vec3& n) {
  return s.half_length * std::abs(s.axis().dot(n)) + s.radius * s.axis().cross(n).norm();
}
inline double reach(const PosedSphere& s, const Vec3&) { return s.radius; }
inline double reach(const PosedCapsule& s, const Vec3& n) {
  return s.half_length * std::abs(s.axis().dot(n)) + s.radius;
}
inline double reach(const PosedBox& s, const Vec3& n) {
  return s.half_extents.dot((s.axes.transpose() * n).cwiseAbs());
}
inline double reach(const PosedConvex& s, const Vec3& n) {
  return s.body.tables().support(s.axes.transpose() * n);
}

/// How far a point lies outside a body, metres; less than zero or zero inside.
inline double outside(const PosedCylinder& s, const Vec3& x) {
  const Vec3 arm = x - s.centre;
  const double z = arm.dot(s.axis());
  return std::max((arm - z * s.axis()).norm() - s.radius, std::abs(z) - s.half_length);
}
inline double outside(const PosedSphere& s, const Vec3& x) {
  return (x - s.centre).norm() - s.radius;
}
inline double outside(const PosedCapsule& s, const Vec3& x) {
  const Vec3 arm = x - s.centre;
  const double z = std::clamp(arm.dot(s.axis()), -s.half_length, s.half_length);
  return (arm - z * s.axis()).norm() - s.radius;
}
inline double outside(const PosedBox& s, const Vec3& x) {
  return ((s.axes.transpose() * (x - s.centre)).cwiseAbs() - s.half_extents).maxCoeff();
}

/// Beyond the planes that touch it along its faces' normals, and along those halfway between two of
/// them: of the least faces a normal may be any, and the plane through one of their edges with it
/// need not leave the body on one side.
inline double outside(const PosedConvex& s, const Vec3& x) {
  const ConvexTables& tables = s.body.tables();
  const Vec3 local = s.axes.transpose() * (x - s.centre);
  double most = -std::numeric_limits<double>::infinity();
  for (const ConvexTables::Planes& faces : tables.faces) {
    most = std::max(most, faces.heights(local).maxCoeff());
  }
  for (const ConvexTables::Edge& e : tables.edges) {
    most = std::max(most, e.middle.dot(local) - e.reach);
  }
  return most;
}

/// The smallest of a body's lengths, and all of them together.
struct Lengths {
  double smallest, sum;
};
inline Lengths lengths(const PosedCylinder& s) {
  return {std::min(s.radius, s.half_length), s.radius + s.half_length};
}
inline Lengths lengths(const PosedPlane& s) {
  constexpr double no_limit = 1;
  return {no_limit, std::abs(s.displacement)};
}
inline Lengths lengths(const PosedSphere& s) { return {s.radius, s.radius}; }
inline Lengths lengths(const PosedCapsule& s) {
  return {std::min(s.radius, s.half_length), s.radius + s.half_length};
}
inline Lengths lengths(const PosedBox& s) {
  const Vec3& e = s.half_extents;
  return {std::min({e.x(), e.y(), e.z()}), e.x() + e.y() + e.z()};
}
/// Its widths may be of any length, and no power of one is taken.
inline Lengths lengths(const PosedConvex& s) {
  constexpr double no_limit = 1;
  return {no_limit, s.body.tables().far};
}

}  // namespace touchstone
