#pragma once

#include <vector>

#include "oracle/hull.hpp"
#include "reference/configuration.hpp"

// Boxes as hulls, for tests: they have to be answered alike.

namespace touchstone {

/// Of a box; number k is at the upper end of axis i if bit i of k is set.
inline std::vector<Vec3> corners_of_box(const Vec3& h) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    corners.emplace_back(k & 1 ? h.x() : -h.x(), k & 2 ? h.y() : -h.y(), k & 4 ? h.z() : -h.z());
  }
  return corners;
}

inline Convex as_hull(const Box& box) {
  return oracle::convex_hull(corners_of_box(box.half_extents()));
}

/// Precondition: B is a box.
inline Configuration with_hull(const Configuration& c) {
  return {c.a, c.pose_a, as_hull(std::get<Box>(c.b)), c.pose_b};
}

}  // namespace touchstone
