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

}  // namespace

Pose::Pose(const Vec3& position, const Eigen::Quaterniond& orientation)
    : position_(position), orientation_(orientation) {
  for (int i = 0; i < 3; ++i) check_finite("position", i, position[i]);
  const double wxyz[] = {orientation.w(), orientation.x(), orientation.y(), orientation.z()};
  for (int i = 0; i < 4; ++i) check_finite("orientation", i, wxyz[i]);
  if (orientation.coeffs().isZero(0)) {
    throw InvalidInput("orientation", "[0, 0, 0, 0]", "must not be the zero quaternion");
  }
}

}  // namespace touchstone
