#pragma once

#include <limits>

#include "contact.hpp"
#include "posed_body.hpp"

namespace touchstone {

/// Tries a few cheap directions and stops at the first along which the bodies are further apart
/// than `threshold`: true, with that direction and its clearance, which the signed distance is not
/// below. The directions come from projecting a point back and forth between the bodies, as von
/// Neumann's alternating projections do. False proves nothing. `b` is a PosedCylinder, PosedCapsule
/// or PosedBox.
template <class Body>
bool quickly_separated(const PosedCylinder& a, const Body& b, double threshold,
                       SignedDistance& clearance) {
  const Vec3 d = a.centre - b.centre;
  Vec3 on_b = nearest(b, a.centre);
  if (threshold == std::numeric_limits<double>::infinity()) return false;
  constexpr double small_part = 0.02;
  const double least = threshold + small_part * a.radius;
  constexpr int rounds = 2;
  for (int i = 0; i < rounds; ++i) {
    const Vec3 on_a = nearest(a, on_b);
    on_b = nearest(b, on_a);
    const Vec3 apart = on_a - on_b;
    const double squared = apart.squaredNorm();
    // The first points may still be far from the nearest ones, but if they are close, so are the
    // bodies.
    if (!(squared > least * least)) return false;
    const Vec3 n = apart / std::sqrt(squared);
    const double along = d.dot(n), reaches = reach(a, n) + reach(b, n), gap = along - reaches;
    // No answer may hang on what rounding makes of a touch.
    constexpr double rounding = 1e-14;
    if (gap > threshold + rounding * (std::abs(along) + reaches)) {
      clearance = {gap, n};
      return true;
    }
  }
  return false;
}

}  // namespace touchstone
