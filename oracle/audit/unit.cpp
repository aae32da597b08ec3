#include "oracle/audit/unit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "reference/invalid_input.hpp"

namespace touchstone::audit {

double unit_of(const Configuration& c) {
  const Vec3 quarter_apart = c.pose_a.position() / 4 - c.pose_b.position() / 4;
  double length = std::max(larger_size(c), quarter_apart.cwiseAbs().maxCoeff());
  if (const auto* plane = std::get_if<Plane>(&c.b)) {
    const double offset = plane->displacement() / plane->normal().cwiseAbs().maxCoeff();
    length = std::max(length, std::abs(offset));
  }
  return std::ldexp(1.0, std::clamp(std::ilogb(length), -1000, 1000));
}

void check_width(double width) {
  if (std::isfinite(width) && width > 0) return;
  throw InvalidInput("width", std::to_string(width), "must be positive and finite");
}

}  // namespace touchstone::audit
