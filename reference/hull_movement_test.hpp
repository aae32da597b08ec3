#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/contact.hpp"

namespace touchstone {

/// How far the hull moves across the vertical, metres: the largest change of its reach.
inline double hull_movement(const Contact& from, const Contact& to) {
  double most = 0;
  for (int i = 0; i < 90; ++i) {
    const double angle = 2 * std::numbers::pi * i / 90;
    const Vec3 n(std::cos(angle), std::sin(angle), 0);
    const auto reach = [&](const Contact& c) {
      double farthest = -std::numeric_limits<double>::infinity();
      for (const auto& p : c.points()) farthest = std::max(farthest, n.dot(p.position));
      return farthest;
    };
    most = std::max(most, std::abs(reach(to) - reach(from)));
  }
  return most;
}

}  // namespace touchstone
