#pragma once

#include <algorithm>
#include <cmath>

#include "rims.hpp"

namespace touchstone {

// Proofs that no way out is shorter than the one along a cap's axis, or across both sides, for
// bodies that overlap so deeply that no ball of that depth fits into one of them. They bound
// F(n) = −g(n) from below for every unit n. Along a great circle F is made of arcs of sinusoids,
// and one that is positive is concave: it is nowhere less than at the arc's ends.

/// A body's lengths and where it is seen from the other's axis.
struct AboutAxis {
  double r, h;           ///< of the cylinder with this axis
  double R, H;           ///< of the other
  double c, s;           ///< of the angle γ between the axes
  double along, across;  ///< of the centres' difference, its length along the axis and across it

  /// Not above F(n) anywhere at an angle θ from the axis. There the other's reach is
  /// S(ψ) = H cos ψ + R sin ψ with a ψ between |γ − θ| and γ + θ, so that
  /// F(n) >= (h − along) cos θ + (r − across) sin θ + min S.
  double bound(double cosine, double sine, double least_reach) const {
    return (h - along) * cosine + (r - across) * sine + least_reach;
  }
  double reach(double cosine, double sine) const { return H * std::abs(cosine) + R * sine; }
  /// Is F not less than `depth` from there up to 90°? The arcs end where a ψ gets to 90 degrees: at
  /// 90° − γ, and at 90°, between which min S is at most R: no sinusoid, but with one of the two
  /// coefficients positive the bound is concave or rises. Beyond 90° `along` has the better sign.
  bool holds_further_on(double depth) const {
    const double at_rest = std::min(R, reach(2 * s * c, std::abs(c - s) * (c + s)));
    return (along <= h || across <= r) && bound(s, c, at_rest) >= depth &&
           bound(0, 1, std::min(R, reach(s, c))) >= depth;
  }
};

/// No normal has less depth than that of the cap of this axis, which is not apart.
///
/// The arcs of the bound above end at θ = 0 (the cap itself), at γ, and further on.
inline bool no_normal_beats_cap(const AboutAxis& x, double depth) {
  const double double_cosine = (x.c - x.s) * (x.c + x.s), double_sine = 2 * x.c * x.s;
  const double at_gamma =
      std::min({x.H, x.reach(double_cosine, double_sine), x.s >= x.c ? x.R : x.H});
  return x.bound(x.c, x.s, at_gamma) >= depth && x.holds_further_on(depth);
}

/// No normal that is further than 0.05 from the axis has less depth than `depth`, for nearly
/// parallel axes. Near its other end the bound is that of `no_normal_beats_cap`.
inline bool no_normal_off_axis_beats(const AboutAxis& x, double depth) {
  constexpr double sine = 0.05, cosine = 0.99874921777190894;
  constexpr double nearly_parallel = 0.02;
  if (!(x.s <= nearly_parallel)) return false;
  const double reach = std::min(x.reach(cosine * x.c + sine * x.s, sine * x.c - cosine * x.s),
                                x.reach(cosine * x.c - sine * x.s, sine * x.c + cosine * x.s));
  const double other_end = (x.h + x.along) * x.c + (x.r - x.across) * x.s +
                           std::min(x.H, x.reach((x.c - x.s) * (x.c + x.s), 2 * x.c * x.s));
  return x.bound(cosine, sine, reach) >= depth && other_end >= depth && x.holds_further_on(depth);
}

/// No normal has less depth than e3, across both sides.
///
/// On the way from e3 to a normal w in the plane of the axes, n = √(1 − σ²) e3 + σ w, F exceeds
/// that of e3 by L σ − Σ ri (1 − √(1 − σ² ki²)) + d3 (1 − √(1 − σ²)), ki = |w·ui|, which is at
/// least L σ − (Q − d3 / 2) σ² with the Q that the sum has at σ = 1. L >= 0 for every w where the
/// axes cross within both bodies; and then that is not negative if it is not at σ = 1, where
/// L − Q = F(w) − r1 − r2. F(w) is least across an edge of the bodies' shadows in the plane.
inline bool no_normal_beats_crossing(const FoldedCylinders& pair) {
  const FoldedAxes& f = pair.axes;
  const auto [t1, t2] = f.crossing();
  return std::abs(t1) <= pair.h1 && std::abs(t2) <= pair.h2 &&
         pair.gap_of_shadows() <= f.d3 / 2 - pair.r1 - pair.r2;
}

/// A rim of this radius at the end of a body of this half length.
struct Rim {
  double r, h;
};

/// No normal has less depth than a stationary one, n, at which two rims meet whose tangents enclose
/// an angle φ, or a rim and a cap (between whose rim's tangent and the other's it is then): at a
/// depth δ that is small against how far they bend the sum away from a ball. `slope` is what is
/// left of the gap's derivative.
///
/// F is the support function of a convex body, so at other normals m at an angle θ from n,
/// F(m) >= x·m with the point x = δ n + slope of that body; and by more for each disc,
/// r (ρ(m) − a·m) >= r (t·m)² / 2 with its tangent t and ρ <= 1, together λ sin² θ / 2 with
/// λ >= r1 r2 sin² φ / (r1 + r2). With δ <= 2 λ / 5 what is left over is λ sin² θ / 18 −
/// slope sin θ >= −4.5 slope² / λ up to cos θ = −0.1.
///
/// Further on n·m = −κ. Of a cylinder n is A u + B a, with u towards its end and a towards its
/// rim's point, so that x = max(0, −u·m) and y = max(0, −a·m) have A x + B y >= κ. Its reach along
/// m exceeds that of this point by h (|u·m| − u·m) + r (ρ(m) − a·m) >= 2 (h x + r y), which is not
/// less than 2 κ min(h, r). That must make up for δ (1 + κ), and does so if it does at κ = 0.1.
///
/// An edge of a box instead of one rim, if it goes on for L beyond the point where they meet,
/// counts as a disc of radius 2 L, because there the box reaches further by at least
/// L |e·m| >= L (e·m)²; and with the smaller half extent across the edge for h.
inline bool bends_away(const Rim& a, const Rim& b, double squared_sine, double depth,
                       double slope) {
  const double lambda = a.r * b.r * squared_sine / (a.r + b.r);
  constexpr double rounding = 1e-16;
  return 5 * depth <= 2 * lambda && 5 * slope * slope <= rounding * (a.r + b.r) * lambda &&
         0.2 * (std::min(a.r, a.h) + std::min(b.r, b.h)) >= 1.1 * depth + slope;
}

/// The same for nearly parallel axes, `about` the second one, along which n lies; `lean` is the
/// larger sine of the angles between n and the axes. Up to an angle θ of 0.1 from n the discs' ρ is
/// no more than the sine of that and of how n leans, so that λ counts that much more, and n is
/// proven there if δ <= λ / 2 over this sine.
inline bool bends_away_near_axis(const Rim& a, const Rim& b, double lean, double squared_sine,
                                 double depth, double slope, const AboutAxis& about) {
  const double lambda = a.r * b.r * squared_sine / (a.r + b.r);
  constexpr double rounding = 1e-16, angle = 0.1, most_lean = 0.05;
  return lean <= most_lean && 2 * depth * (angle + lean) <= lambda &&
         slope * slope <= rounding * (a.r + b.r) * lambda && no_normal_off_axis_beats(about, depth);
}

}  // namespace touchstone
