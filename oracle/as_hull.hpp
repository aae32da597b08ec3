#pragma once

#include "oracle/hull.hpp"
#include "reference/configuration.hpp"

// Boxes as hulls, for tests: they have to be answered alike.

namespace touchstone {

/// Vertex k is at the upper end of axis i if bit i of k is set.
inline Convex as_hull(const Box& box) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    const Vec3 signs(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    corners.emplace_back(signs.cwiseProduct(box.half_extents()));
  }
  return oracle::convex_hull(corners);
}

/// Precondition: B is a box.
inline Configuration with_hull(const Configuration& c) {
  return {c.a, c.pose_a, as_hull(std::get<Box>(c.b)), c.pose_b};
}

}  // namespace touchstone
