#pragma once

#include <algorithm>
#include <cmath>

#include "rims.hpp"

namespace touchstone {

// Proofs that no way out is shorter than the one along a cap's axis, or across both sides, for
// bodies that overlap so deeply that no ball of that depth fits into one of them. They bound
// F(n) = −g(n) from below for every unit n. Along a great circle F is made of arcs of sinusoids,
// and one that is positive is concave: it is nowhere less than at the arc's ends.

/// No less depth than `depth` along any normal, which that of a cap has: of the cylinder r, h,
/// whose axis the other, R, H, is seen at with cosine c and sine s, its centre `along` and `across`
/// it.
///
/// At an angle θ from the axis, S(ψ) = H cos ψ + R sin ψ of the other has a ψ between |γ − θ| and
/// γ + θ, so that F(n) >= (h − along) cos θ + (r − across) sin θ + min S, whose arcs end where a ψ
/// gets to 0 or 90 degrees: at θ = 0 (the cap itself), γ, 90° − γ and 90°.
inline bool no_normal_beats_cap(double depth, double r, double h, double R, double H, double c,
                                double s, double along, double across) {
  const double a = h - along, b = r - across;
  if (!(a >= 0 && b >= 0)) return false;
  const double cosine = std::abs(c - s) * (c + s), sine = 2 * c * s;  // of 2γ, folded
  const double at_gamma = std::min({H, H * cosine + R * sine, s >= c ? R : H});
  const double at_rest = std::min(R, H * sine + R * cosine);
  const double at_right_angle = std::min(R, H * s + R * c);
  return a * c + b * s + at_gamma >= depth && a * s + b * c + at_rest >= depth &&
         b + at_right_angle >= depth;
}

/// No normal has less depth than e3, across both sides.
///
/// On the way from e3 to a normal w in the plane of the axes, n = √(1 − σ²) e3 + σ w, F exceeds
/// that of e3 by L σ − Σ ri (1 − √(1 − σ² ki²)) + d3 (1 − √(1 − σ²)), ki = |w·ui|, which is at
/// least L σ − (Q − d3 / 2) σ² with the Q that the sum has at σ = 1. L >= 0 for every w where the
/// axes cross within both bodies; and then that is not negative if it is not at σ = 1, where L − Q
/// = F(w) − r1 − r2. F(w) is least across an edge of the bodies' shadows in the plane.
inline bool no_normal_beats_crossing(const FoldedCylinders& pair) {
  const FoldedAxes& f = pair.axes;
  const double t2 = f.d2 / f.s, t1 = f.d1 - f.c * t2;
  return std::abs(t1) <= pair.h1 && std::abs(t2) <= pair.h2 &&
         pair.gap_of_shadows() <= f.d3 / 2 - pair.r1 - pair.r2;
}

}  // namespace touchstone
