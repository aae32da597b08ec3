#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "shape.hpp"

namespace touchstone {

/// Position (metres) and orientation of a body in the world. The orientation is kept as given: it
/// need not have unit length, only be finite and not zero. The oracle divides by its exact norm;
/// everyone else uses `rotation()` or `unit_orientation()`, which normalise in double.
class Pose {
 public:
  Pose() = default;
  /// Throws InvalidInput on NaN, infinity or a zero quaternion.
  Pose(const Vec3& position, const Eigen::Quaterniond& orientation)
      : position_(position), orientation_(orientation), rotation_() {  // set below
    // One by one: Eigen would load in pairs what was just stored singly, which stalls.
    const double w = orientation.w(), x = orientation.x(), y = orientation.y();
    const double z = orientation.z(), squared = w * w + x * x + y * y + z * z;
    if (squared > min_squared && squared < max_squared && is_moderate(position)) {
      rotate_by(orientation, squared);
    } else {
      check_and_rotate();
    }
  }

  /// Not turned; of a sphere that is all there is to know. Throws InvalidInput on NaN or infinity.
  explicit Pose(const Vec3& position) : position_(position) {
    if (!is_moderate(position)) check_and_rotate();
  }

  const Vec3& position() const { return position_; }
  /// As given; Eigen's constructor order is (w, x, y, z).
  const Eigen::Quaterniond& orientation() const { return orientation_; }
  /// The orientation with unit length, to within rounding, however long or short it was given.
  Eigen::Quaterniond unit_orientation() const;
  /// Body frame to world frame, made once for each pose.
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  /// The body's local z in the world: the axis of a cylinder or capsule.
  Vec3 axis() const { return rotation_.col(2); }

 private:
  /// Between these, no digit of a quaternion's squared length is lost to overflow or underflow.
  static constexpr double min_squared = 1e-280, max_squared = 1e280;
  /// NaN and infinity survive a sum of absolute values; of finite positions it may overflow.
  static bool is_moderate(const Vec3& x) {
    return std::abs(x.x()) + std::abs(x.y()) + std::abs(x.z()) < max_squared;
  }
  /// R(q) of a quaternion of any length: dividing by |q|² once needs no square root.
  void rotate_by(const Eigen::Quaterniond& q, double squared) {
    const double s = 2 / squared;
    const double w = s * q.w(), x = s * q.x(), y = s * q.y(), z = s * q.z();
    const double wx = w * q.x(), wy = w * q.y(), wz = w * q.z();
    const double xx = x * q.x(), xy = x * q.y(), xz = x * q.z();
    const double yy = y * q.y(), yz = y * q.z(), zz = z * q.z();
    // Coefficient by coefficient: of columns, the compiler stores two and loads them as one.
    rotation_(0, 0) = 1 - (yy + zz), rotation_(0, 1) = xy - wz, rotation_(0, 2) = xz + wy;
    rotation_(1, 0) = xy + wz, rotation_(1, 1) = 1 - (xx + zz), rotation_(1, 2) = yz - wx;
    rotation_(2, 0) = xz - wy, rotation_(2, 1) = yz + wx, rotation_(2, 2) = 1 - (xx + yy);
  }
  /// Throws InvalidInput, or rotates by a quaternion whose square overflows or vanishes.
  void check_and_rotate();

  Vec3 position_ = Vec3::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

/// The shortest rotation that carries the direction `from` to the direction `to`; neither need have
/// unit length. Of opposite directions, a half turn about some axis across them. (Eigen's
/// FromTwoVectors finds that axis by a singular value decomposition, which takes the compiler nine
/// seconds in every source.)
Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to);

}  // namespace touchstone
