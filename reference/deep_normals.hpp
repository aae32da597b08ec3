#pragma once

#include <algorithm>
#include <cmath>

#include "rims.hpp"

namespace touchstone {

// Proofs that no normal has a larger gap than a given one where no ball of that depth behind the
// place where the bodies meet says so. Of bodies that overlap they are bounds from below of
// F(n) = −g(n) for every unit n (proofs.md, "Deep normals"; deep_normals_test.cpp holds each
// against random normals). A false answer says nothing.

/// Proves of bodies that are apart that no normal has more than this gap, but for rounding: of a
/// normal at which a point of each faces the other but for a slope, which are √(gap² + slope²)
/// apart.
inline bool is_met_by_points(double gap, double slope, double rounding) {
  return gap > 0 && slope * slope <= rounding * (2 * gap + rounding);
}

/// A body's lengths and where it is seen from the other's axis.
struct AboutAxis {
  double r, h;           ///< of the cylinder with this axis
  double R, H;           ///< of the other
  double c, s;           ///< of the angle γ between the axes
  double along, across;  ///< of the centres' difference, its length along the axis and across it

  /// Not above F(n) anywhere at an angle θ from the axis, with these values of cos θ and sin θ,
  /// where the other's reach is at least `min_reach`.
  double bound(double cosine, double sine, double min_reach) const {
    return (h - along) * cosine + (r - across) * sine + min_reach;
  }
  /// The other's reach at an angle from its own axis.
  double reach(double cosine, double sine) const { return H * std::abs(cosine) + R * sine; }
  /// Returns whether F is not less than `depth` from θ = 90° − γ on.
  bool holds_further_on(double depth) const {
    const double at_rest = std::min(R, reach(2 * s * c, std::abs(c - s) * (c + s)));
    return (along <= h || across <= r) && bound(s, c, at_rest) >= depth &&
           bound(0, 1, std::min(R, reach(s, c))) >= depth;
  }
};

/// Proves that no normal has less depth than that of the cap of this axis, which is not apart.
inline bool no_normal_beats_cap(const AboutAxis& x, double depth) {
  const double double_cosine = (x.c - x.s) * (x.c + x.s), double_sine = 2 * x.c * x.s;
  const double at_gamma =
      std::min({x.H, x.reach(double_cosine, double_sine), x.s >= x.c ? x.R : x.H});
  return x.bound(x.c, x.s, at_gamma) >= depth && x.holds_further_on(depth);
}

/// Sine of an angle from the axis, of a cone that is wide against the angle between nearly parallel
/// axes.
inline double sine_of_cone(const AboutAxis& x) {
  return std::max(std::min(std::max(50 * x.s, 1e-10), 0.05), 2.5 * x.s);
}

/// Proves that no normal outside the cone has less depth; for nearly parallel axes.
inline bool no_normal_off_axis_beats(const AboutAxis& x, double depth) {
  constexpr double nearly_parallel = 0.11;
  if (!(x.s <= nearly_parallel)) return false;
  const double sine = sine_of_cone(x), cosine = std::sqrt((1 - sine) * (1 + sine));
  const double reach = std::min(x.reach(cosine * x.c + sine * x.s, sine * x.c - cosine * x.s),
                                x.reach(cosine * x.c - sine * x.s, sine * x.c + cosine * x.s));
  const double other_end = (x.h + x.along) * x.c + (x.r - x.across) * x.s +
                           std::min(x.H, x.reach((x.c - x.s) * (x.c + x.s), 2 * x.c * x.s));
  return x.bound(cosine, sine, reach) >= depth && other_end >= depth && x.holds_further_on(depth);
}

/// Proves that no normal has less depth than that of the cap of this axis, for nearly parallel
/// axes. All else has a slope of this length there, and a rim of this radius holds the normal
/// against it.
inline bool no_normal_beats_held_cap(const AboutAxis& x, double slope, double radius,
                                     double depth) {
  constexpr double half = 0.52;  // and what a tangent is more than its sine
  return slope <= radius - half * sine_of_cone(x) * depth && no_normal_off_axis_beats(x, depth);
}

/// Proves that no normal has less depth than e3, across both sides.
inline bool no_normal_beats_crossing(const FoldedCylinders& pair) {
  const FoldedAxes& f = pair.axes;
  const auto [t1, t2] = f.crossing();
  return std::abs(t1) <= pair.h1 && std::abs(t2) <= pair.h2 &&
         pair.gap_of_shadows() <= f.d3 / 2 - pair.r1 - pair.r2;
}

/// A rim of this radius at the end of a body of this half length. An edge of a box that goes on for
/// L beyond the point where it meets a rim counts as one of radius 2 L, at the end of a body of the
/// smaller half extent across the edge.
struct Rim {
  double r, h;
};

/// Proves that no normal has less depth than a stationary one at which two rims meet, whose
/// tangents enclose an angle with this squared sine; or a rim and a cap, with the angle between the
/// rim's tangent and the other rim's. `slope` is what is left of the gap's derivative.
inline bool bends_away(const Rim& a, const Rim& b, double squared_sine, double depth,
                       double slope) {
  const double lambda = a.r * b.r * squared_sine / (a.r + b.r);
  constexpr double rounding = 1e-16;
  return 5 * depth <= 2 * lambda && 5 * slope * slope <= rounding * (a.r + b.r) * lambda &&
         0.2 * (std::min(a.r, a.h) + std::min(b.r, b.h)) >= 1.1 * depth + slope;
}

/// Proves the same of nearly parallel axes, up to larger depths. `about` is the second axis, along
/// which the normal lies; `lean` is the larger sine of the angles between the normal and the axes.
inline bool bends_away_near_axis(const Rim& a, const Rim& b, double lean, double squared_sine,
                                 double depth, double slope, const AboutAxis& about) {
  const double lambda = a.r * b.r * squared_sine / (a.r + b.r);
  const double cone = sine_of_cone(about);
  constexpr double rounding = 1e-16;
  return lean <= cone && 5 * depth * (cone + about.s) <= 4 * lambda &&
         slope * slope <= rounding * (a.r + b.r) * lambda && no_normal_off_axis_beats(about, depth);
}

/// Proves that no normal is a maximum of the gap where rims of these ends meet, of bodies that
/// overlap by no less than this (proofs.md, "Rims that overlap deeply").
inline bool overlap_too_deeply(const FoldedCylinders& pair, bool same_ends, double least_depth) {
  const FoldedAxes& f = pair.axes;
  const double r1 = pair.r1, r2 = pair.r2, product = r1 * r2;
  const double squared = r1 * r1 + r2 * r2 + 2 * (same_ends ? f.c : -f.c) * product;
  constexpr double rounding = 1e-9;
  return f.d3 * f.d3 * squared * std::sqrt(squared) <
         (1 - rounding) * least_depth * product * product * f.s;
}

}  // namespace touchstone
