#pragma once

#include <limits>

#include "contact.hpp"
#include "posed_body.hpp"

namespace touchstone {

/// Tries the direction between two points that face each other, found by projecting a point from
/// body to body three times (von Neumann's alternating projections; more seldom help). True if the
/// bodies are further apart along it than `threshold`, with that direction and its clearance, which
/// the signed distance is not below. False proves nothing. `b` is a PosedCylinder, PosedCapsule or
/// PosedBox.
template <class Body>
bool quickly_separated(const PosedCylinder& a, const Body& b, double threshold,
                       SignedDistance& clearance) {
  if (threshold == std::numeric_limits<double>::infinity()) return false;
  const Vec3 on_a = nearest(a, nearest(b, a.centre));
  const Vec3 apart = on_a - nearest(b, on_a);
  const double squared = apart.squaredNorm();
  // These points may still be far from the nearest ones, but if they are close, so are the bodies.
  constexpr double small_part = 0.02;
  const double least = threshold + small_part * a.radius;
  if (!(squared > least * least)) return false;
  const Vec3 n = (1 / std::sqrt(squared)) * apart;
  const double along = n.dot(a.centre - b.centre), reaches = reach(a, n) + reach(b, n);
  // No answer may hang on what rounding makes of a touch.
  constexpr double rounding = 1e-14;
  if (!(along - reaches > threshold + rounding * (std::abs(along) + reaches))) return false;
  clearance = {along - reaches, n};
  return true;
}

}  // namespace touchstone
