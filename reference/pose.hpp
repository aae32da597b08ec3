#pragma once

#include <Eigen/Geometry>

#include "shape.hpp"

namespace touchstone {

/// Position (metres) and orientation of a body in the world. The orientation is kept as given: it
/// need not have unit length, only be finite and not zero. The oracle divides by its exact norm;
/// everyone else uses `rotation()`, which normalises in double.
class Pose {
 public:
  Pose() = default;
  /// Throws InvalidInput on NaN, infinity or a zero quaternion.
  Pose(const Vec3& position, const Eigen::Quaterniond& orientation);

  const Vec3& position() const { return position_; }
  /// As given; Eigen's constructor order is (w, x, y, z).
  const Eigen::Quaterniond& orientation() const { return orientation_; }
  /// Body frame to world frame, made once for each pose.
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  /// The body's local z in the world: the axis of a cylinder or capsule.
  Vec3 axis() const { return rotation_.col(2); }

 private:
  Vec3 position_ = Vec3::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

}  // namespace touchstone
