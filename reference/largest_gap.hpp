#pragma once

#include <limits>

#include "shape.hpp"

namespace touchstone {

/// The largest clearance met so far and its normal, in whatever frame the pair is solved in.
struct LargestGap {
  double gap = -std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::UnitZ();

  /// Of normals that tie the first one stays.
  void offer(double other, const Vec3& n) {
    if (other > gap) gap = other, normal = n;
  }
};

}  // namespace touchstone
