#include "disc_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchstone {
namespace {

constexpr double half = 0.5, height = std::numbers::sqrt3 / 2;  // cos 60°, sin 60°

}  // namespace

double deepest_point_weight(double rise, double clear_rise) {
  return rise <= clear_rise ? 0 : std::min((rise - clear_rise) / clear_rise, 1.0);
}

std::array<Vec2, 3> three_arms(double radius, const Vec2& unit) {
  const Vec2 arm = radius * unit, across = height * Vec2(-arm.y(), arm.x());
  return {arm, across - half * arm, -across - half * arm};
}

int spread_disc(double radius, const Vec2& slope, const Vec2& anchor, double slack,
                double clear_rise, std::array<Vec2, 6>& arms) {
  const double steepness = slope.norm(), rise = 2 * radius * steepness;
  int count = 0;
  const double way = deepest_point_weight(rise, clear_rise);
  if (way == 0) {
    for (const Vec2& arm : three_arms(radius, anchor)) arms[count++] = arm;
    return count;
  }
  // From half the slack to three quarters of it, so that nothing of the old layout is above it.
  const HandOver over{8 * rise / slack - 4};
  if (!over.is_over()) {
    for (const Vec2& arm : three_arms(over.old_size() * radius, anchor)) arms[count++] = arm;
  }
  const Vec2 lowest = (-radius / steepness) * slope;
  arms[count++] = way * lowest;
  if (!over.has_begun()) return count;
  double cosine = -half, sine = height;
  if (steepness * radius * (1 + half) > slack) {
    cosine = 1 - slack / (steepness * radius);
    sine = std::sqrt((1 - cosine) * (1 + cosine));
  }
  const double size = over.new_size();
  const Vec2 ahead = size * cosine * lowest, across = size * sine * Vec2(-lowest.y(), lowest.x());
  arms[count++] = ahead + across;
  arms[count++] = ahead - across;
  return count;
}

}  // namespace touchstone
