// The bounds by which the search of rims leaves arcs out (reference/proofs.md, "The search of
// rims"), held against the rims themselves at points of each arc, in long double and by other
// formulas.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/mutation/judge.hpp"

namespace touchstone::mutation {
namespace {

/// A point of rim 1 and its distance D from rim 2, with derivatives by the angle.
struct RimPoint {
  Real speed, radial, rate, second, turn;  ///< seen along axis 2
  Real slope, third;                       ///< first and third derivative of D² / 2
  Vector apart;                            ///< from rim 1's point to rim 2's
  Real height, outward1, sine2, along1, along2;

  RimPoint(const RawArc& x, Real angle) {
    const Real c = x.c, s = x.s, r1 = x.r1, r2 = x.r2;
    const Real cos1 = std::cos(angle), sin1 = std::sin(angle);
    const Vector p(x.q[0], x.q[1] - r1 * cos1, x.q[2] - r1 * sin1);
    const Real k = c * p.y() - s * p.x();
    height = c * p.x() + s * p.y();
    radial = std::hypot(k, p.z());
    const Real cos2 = k / radial;
    sine2 = p.z() / radial;
    // The velocity and acceleration along the radius and across it.
    const Real v = r1 * (c * sin1 * cos2 - cos1 * sine2),
               w = -r1 * (c * sin1 * sine2 + cos1 * cos2);
    const Real f = r1 * (c * cos1 * cos2 + sin1 * sine2), g = r1 * (sin1 * cos2 - c * cos1 * sine2);
    speed = std::hypot(v, w), turn = std::abs(w) / radial;
    rate = v, second = f + w * w / radial;
    const Real third_of_radial = -v + 3 * w * g / radial - 3 * v * w * w / (radial * radial);
    const Real beside = radial - r2, h1 = s * r1 * sin1, h2 = s * r1 * cos1;
    slope = height * h1 + beside * rate;
    third = -height * h1 + 3 * h1 * h2 + 3 * rate * second + beside * third_of_radial;
    apart = Vector(c * height - s * beside * cos2, s * height + c * beside * cos2, beside * sine2);
    outward1 = apart.y() * cos1 + apart.z() * sin1;
    along1 = c * cos1 * sine2 - sin1 * cos2, along2 = cos1 * sine2 - c * sin1 * cos2;
  }

  /// Whether the rims may meet there along `way` times the vector between them.
  bool may_meet(const RawArc& x, Real end1, Real end2, Real way) const {
    return std::min({sine2, end1 * along1, end2 * along2, way * end1 * apart.x(),
                     way * end2 * height, way * apart.z(), way * outward1,
                     way * (radial - x.r2)}) >= 0;
  }
};

void judge_arc(const RawArc& x, Real end1, Real end2, Real angle, Real half_width,
               const std::function<void(bool, ArcCheck)>& expect) {
  const Real size = x.r1 + x.r2 + vector(x.q).norm(), rounding = 1e-13L * size;
  // Closer to the axis the point's direction is rounding.
  constexpr Real close = 1e-4L;
  const bool clear = x.min_radial > close * size && x.r1 > close * size;
  Real previous = 0;
  constexpr int count = 8;
  for (int i = 0; i <= count; ++i) {
    const RimPoint p(x, angle + half_width * (2 * i - count) / count);
    expect(p.speed <= x.max_speed + rounding && p.speed >= x.min_speed - rounding &&
               p.radial <= x.max_radial + rounding && p.radial >= x.min_radial - rounding,
           ArcCheck::passage);
    if (clear) {
      constexpr Real digits = 1 + 1e-6L;
      expect(p.turn <= digits * x.turn + 1e-9L &&
                 std::abs(p.rate) <= x.max_rate * digits + rounding &&
                 std::abs(p.second) <= x.max_second * digits + 1e5L * rounding &&
                 std::abs(p.third) * half_width <= x.r1 * x.max_bend * digits,
             ArcCheck::derivatives);
      expect(!x.points_inward || end1 * p.apart.x() > -rounding, ArcCheck::directions);
      expect(x.may_meet_overlapping || !p.may_meet(x, end1, end2, -1), ArcCheck::directions);
      expect(x.may_meet_apart || !p.may_meet(x, end1, end2, 1), ArcCheck::directions);
    }
    const bool minimum = i > 0 && previous < -rounding * size && p.slope > rounding * size;
    expect(!(x.only_maxima && minimum), ArcCheck::minima);
    previous = p.slope;
  }
}

/// No bound is smaller than proofs.md derives it, also where the rims would not show that.
void judge_derivation(const RawArc& x, Real angle, Real half_width,
                      const std::function<void(bool, ArcCheck)>& expect) {
  const RimPoint middle(x, angle);
  constexpr Real digits = 1 - 1e-9L;
  const Real s = x.s, r1 = x.r1, r2 = x.r2, size = r1 + r2 + vector(x.q).norm();
  const Real max_rise = s * r1 * std::min<Real>(1, std::abs(std::sin(angle)) + half_width);
  const Real max_height = std::abs(middle.height) + s * r1 * half_width;
  if (x.only_maxima) {
    const Real inside = r2 - x.max_radial, along = max_height * max_rise / inside;
    const Real across_squared = x.min_speed * x.min_speed - along * along;
    expect(max_rise * max_rise + along * along + max_height * s * r1 + r2 * r1 <
               inside * across_squared / x.max_radial / digits,
           ArcCheck::minima);
  }
  constexpr Real close = 1e-4L;
  if (!(x.min_radial > close * size && r1 > close * size)) return;
  const Real radial = x.min_radial, v = x.max_speed, turn = v / radial;
  const Real k = x.c * x.q[1] - s * x.q[0];
  const Real wave =
      (2 * r1 * std::hypot(k, static_cast<Real>(x.q[2])) + 4 * r1 * r1 * s * s) / (radial * radial);
  const Real second = std::min(r1 + v * turn, radial * wave * (0.5L + wave / 4));
  const Real rate = std::min({v, radial * wave / 2, std::abs(middle.rate) + second * half_width});
  const Real third = std::min(v * (1 + 1.154L * turn * turn) + 3 * r1 * turn,
                              radial * wave * (0.5L + 0.75L * wave + 0.375L * wave * wave));
  const Real beside = std::abs(middle.radial - r2) + rate * half_width;
  const Real sine = std::min<Real>(0.5L, std::abs(std::sin(angle)) + half_width);
  const Real derivative =
      s * (max_height + 3 * s * r1 * sine) + (beside * third + 3 * rate * second) / r1;
  const Real noise = 3.77e-15L * size * (1 + 0.27L * r2 / radial) * (1.12L + 2.8L * r1 / radial);
  expect(x.turn >= digits * turn && x.max_second >= digits * second - 1e-15L * size &&
             x.max_rate >= digits * rate - 1e-15L * size,
         ArcCheck::derivatives);
  expect(x.max_bend >= digits * (derivative * half_width + noise), ArcCheck::derivatives);
  if (x.points_inward) {
    expect(std::abs(middle.apart.x()) >= digits * s * r2 * turn * half_width, ArcCheck::directions);
  }
}

}  // namespace

void judge_arcs(const void* made, const Routines& routines, std::size_t index,
                const std::function<void(bool, ArcCheck)>& expect) {
  const double end1 = index % 2 == 0 ? 1 : -1, end2 = index / 2 % 2 == 0 ? 1 : -1;
  const RawArc rims = routines.arc(made, end1, end2, 0, 0);
  constexpr double min_length = 1e-20, max_length = 1e20;
  if (!(rims.r1 > min_length && rims.r2 + vector(rims.q).norm() < max_length)) return;
  // Where the rim passes closest to the other's axis, beside that, and anywhere.
  double closest = 0;
  Real least = max_length;
  constexpr int places = 16;
  for (int i = 0; i <= places; ++i) {
    const double angle = std::numbers::pi * i / places;
    if (const Real radial = RimPoint(rims, angle).radial; radial < least) {
      least = radial, closest = angle;
    }
  }
  for (const double half_width : {1.5, 0.4, 0.1, 0.02, 1e-3}) {
    for (const double angle : {closest, closest + 1.5 * half_width, 0.7, 2.2}) {
      const RawArc arc = routines.arc(made, end1, end2, angle, half_width);
      judge_arc(arc, end1, end2, angle, half_width, expect);
      judge_derivation(arc, angle, half_width, expect);
    }
  }
}

}  // namespace touchstone::mutation
