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

}  // namespace

void Pose::check_and_rotate() {
  if (!position_.allFinite() || !orientation_.coeffs().allFinite() ||
      orientation_.coeffs().isZero(0)) {
    refuse(position_, orientation_);
  }
  const double largest = orientation_.coeffs().cwiseAbs().maxCoeff();
  const Eigen::Quaterniond scaled(orientation_.coeffs() / largest);
  rotate_by(scaled, scaled.squaredNorm());
}

}  // namespace touchstone
