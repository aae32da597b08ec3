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

/// The quaternion times the power of two that makes its largest component 1 to 2: exact, but for
/// components that vanish against that one, and no square overflows or vanishes.
Eigen::Quaterniond in_range(const Eigen::Quaterniond& q) {
  const int exponent = std::ilogb(q.coeffs().cwiseAbs().maxCoeff());
  return Eigen::Quaterniond(Eigen::Vector4d(
      q.coeffs().unaryExpr([exponent](double x) { return std::scalbn(x, -exponent); })));
}

}  // namespace

void Pose::check_and_rotate() {
  if (!position_.allFinite() || !orientation_.coeffs().allFinite() ||
      orientation_.coeffs().isZero(0)) {
    refuse(position_, orientation_);
  }
  const Eigen::Quaterniond q = in_range(orientation_);
  rotate_by(q, q.squaredNorm());
}

Eigen::Quaterniond Pose::unit_orientation() const {
  const double squared = orientation_.squaredNorm();
  const bool squares_in_range = squared > min_squared && squared < max_squared;
  return (squares_in_range ? orientation_ : in_range(orientation_)).normalized();
}

Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to) {
  constexpr double opposite = -1 + 1e-12;  // Below it, s has lost half of its digits.
  const Vec3 u = from.normalized(), v = to.normalized();
  const double c = u.dot(v);
  Eigen::Quaterniond turn;
  if (c < opposite) {
    turn.w() = 0;
    turn.vec() = u.unitOrthogonal();
    return turn;
  }
  const double s = std::sqrt((1 + c) * 2);
  turn.w() = s * 0.5;
  turn.vec() = u.cross(v) * (1 / s);
  return turn;
}

}  // namespace touchstone
