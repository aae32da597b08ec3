#include "pose.hpp"

#include <cmath>
#include <sstream>
#include <string>

#include "invalid_input.hpp"

namespace touchstone {
namespace {

void check_finite(const char* field, int index, double value) {
  if (std::isfinite(value)) return;
  std::ostringstream text;
  text << value;
  throw InvalidInput(std::string(field) + "[" + std::to_string(index) + "]", text.str(),
                     "must be finite");
}

/// Names the field at fault.
[[noreturn]] void refuse(const Vec3& position, const Eigen::Quaterniond& orientation) {
  for (int i = 0; i < 3; ++i) check_finite("position", i, position[i]);
  const double wxyz[] = {orientation.w(), orientation.x(), orientation.y(), orientation.z()};
  for (int i = 0; i < 4; ++i) check_finite("orientation", i, wxyz[i]);
  throw InvalidInput("orientation", "[0, 0, 0, 0]", "must not be the zero quaternion");
}

/// R(q) of a quaternion of any length: dividing by |q|² once needs no square root.
Eigen::Matrix3d rotation_of(const Eigen::Quaterniond& q, double squared) {
  const double s = 2 / squared;
  const double w = s * q.w(), x = s * q.x(), y = s * q.y(), z = s * q.z();
  const double wx = w * q.x(), wy = w * q.y(), wz = w * q.z();
  const double xx = x * q.x(), xy = x * q.y(), xz = x * q.z();
  const double yy = y * q.y(), yz = y * q.z(), zz = z * q.z();
  Eigen::Matrix3d m;
  m << 1 - (yy + zz), xy - wz, xz + wy,  //
      xy + wz, 1 - (xx + zz), yz - wx,   //
      xz - wy, yz + wx, 1 - (xx + yy);
  return m;
}

}  // namespace

Pose::Pose(const Vec3& position, const Eigen::Quaterniond& orientation)
    : position_(position), orientation_(orientation) {
  const double squared = orientation.squaredNorm();
  // NaN and infinity survive a sum of absolute values; of finite positions it may overflow.
  constexpr double least = 1e-280, most = 1e280;
  const bool plain = squared > least && squared < most && position.cwiseAbs().sum() < most;
  if (plain) {
    rotation_ = rotation_of(orientation, squared);
    return;
  }
  if (!position.allFinite() || !orientation.coeffs().allFinite() ||
      orientation.coeffs().isZero(0)) {
    refuse(position, orientation);
  }
  const double largest = orientation.coeffs().cwiseAbs().maxCoeff();
  const Eigen::Quaterniond scaled(orientation.coeffs() / largest);
  rotation_ = rotation_of(scaled, scaled.squaredNorm());
}

}  // namespace touchstone
