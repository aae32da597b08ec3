#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "properties/moves.hpp"
#include "reference/configuration.hpp"
#include "reference/contact.hpp"
#include "reference/posed_body.hpp"

namespace touchstone {

// What tests of contact points share: poses, and that every point lies on both bodies.

using Quaternion = Eigen::Quaterniond;

inline const Quaternion aslant(0.9, 0.3, 0.2, 0.1);

/// How far the point lies beyond A's surface (positive outside), and B's.
inline double outside(const Cylinder& s, const Vec3& x) {
  return std::max(std::hypot(x.x(), x.y()) - s.radius(), std::abs(x.z()) - s.half_length());
}
inline double outside(const Plane& s, const Vec3& x) {
  return s.unit_normal().dot(x) - s.unit_displacement();
}
inline double outside(const Sphere& s, const Vec3& x) { return x.norm() - s.radius(); }
inline double outside(const Capsule& s, const Vec3& x) {
  const double z = std::clamp(x.z(), -s.half_length(), s.half_length());
  return (x - Vec3(0, 0, z)).norm() - s.radius();
}
inline double outside(const Box& s, const Vec3& x) {
  return (x.cwiseAbs() - s.half_extents()).maxCoeff();
}
inline double outside(const Convex& s, const Vec3& x) {
  return outside(posed(s, Pose(), Vec3::Zero()), x);
}
inline double outside(const Shape& shape, const Pose& pose, const Vec3& x) {
  const Vec3 local = pose.rotation().transpose() * (x - pose.position());
  return std::visit([&](const auto& s) { return outside(s, local); }, shape);
}

inline double position_rounding(const Configuration& c) {
  return 4e-16 * (c.pose_a.position().norm() + c.pose_b.position().norm());
}

/// Where a round body leans by θ, points beside its deepest one are seen at a slant, which moves
/// them into it by up to θ²/2 of its size. Those that are kept lie within a thousandth of the size,
/// and no farther above the deepest point than that is deep: θ <= 1e-2 min(1, depth / 1e-3).
inline double seen_at_a_slant(const Configuration& c, const Contact& answer) {
  const double slack = std::min(1e-3 * larger_size(c), std::max(0.0, -answer.signed_distance));
  return 50 * slack * slack / larger_size(c);
}

/// Each point, moved by half its depth along the normal, lies on A's surface, and against it on
/// B's; the deepest has the contact's depth, but for `unseen`.
inline void expect_points_on_both(const Configuration& c, const Contact& answer, double tolerance,
                                  double unseen = 0) {
  const double aside = tolerance + seen_at_a_slant(c, answer);
  double deepest = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : answer.points()) {
    EXPECT_NEAR(outside(c.a, c.pose_a, p.position - p.depth / 2 * answer.normal), 0, aside);
    EXPECT_NEAR(outside(c.b, c.pose_b, p.position + p.depth / 2 * answer.normal), 0, aside);
    deepest = std::max(deepest, p.depth);
  }
  if (answer.points().empty()) return;
  constexpr double steepest = 1e-2;  // what is moved aside changes the depth by the slope
  // Of a patch that leans by no more than two millionths of its size the deepest point is not one.
  const double unclear = answer.points().size() >= 3 ? 4e-7 * larger_size(c) : 0;
  EXPECT_NEAR(deepest, -answer.signed_distance,
              tolerance + unseen + unclear + steepest * seen_at_a_slant(c, answer));
}

}  // namespace touchstone
