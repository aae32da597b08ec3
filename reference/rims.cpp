#include "rims.hpp"

namespace touchstone {
namespace {

double sine_of(double cosine) { return std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine))); }

/// A quarter of a rim: |cos| within a range, and sin accordingly.
struct Quarter {
  Range cosine, sine;

  /// Next to 1 the sines of different cosines are rounded alike, and either way.
  explicit Quarter(const Range& c)
      : cosine(c), sine{sine_of(c.hi) - rounding, sine_of(c.lo) + rounding} {}
  /// Keeps the part whose sine is within these bounds.
  void keep(double min_sine, double max_sine) {
    if (sine.hi > max_sine) sine.hi = std::max(max_sine, 0.0), cosine.lo = sine_of(sine.hi);
    if (sine.lo < min_sine) sine.lo = std::min(min_sine, 1.0), cosine.hi = sine_of(sine.lo);
  }

 private:
  static constexpr double rounding = 1e-15;
};

/// Range of G x for a gap G between `lowest` and `highest` and positive x.
Range product(double lowest, double highest, const Range& x) {
  return {lowest * (lowest < 0 ? x.hi : x.lo), highest * (highest < 0 ? x.lo : x.hi)};
}

/// Range of |cos| where cos has this sign and sign * cos = offset + end * x.
Range cosines(double offset, double end, const Range& x, double sign) {
  const double at_lo = sign * (offset + end * x.lo), at_hi = sign * (offset + end * x.hi);
  return {std::max(0.0, std::min(at_lo, at_hi)), std::min(1.0, std::max(at_lo, at_hi))};
}

}  // namespace

// φ is a constant less r1 (q2 cos α + q3 sin α) and r2 R (proofs.md, "On short arcs").
double Rims::max_third_derivative_of_short(const RimSample& x, double half_width,
                                           const Passage& p) const {
  const double c = pair_.axes.c, r1 = pair_.r1, r2 = pair_.r2, v = p.max_speed;
  // Derivatives of rim 1's point as seen along axis 2, over r1; and of R.
  const double k1 = c * x.sin1, z1 = -x.cos1, k2 = c * x.cos1, z2 = x.sin1;
  const double across = r1 * (x.cos2 * z1 - x.sin2 * k1), inverse = 1 / x.radial;
  const double rate = r1 * (x.cos2 * k1 + x.sin2 * z1);
  const double second = r1 * (x.cos2 * k2 + x.sin2 * z2) + across * across * inverse;
  const double third = 3 * (r1 * r1 * (k1 * k2 + z1 * z2) - rate * second) * inverse - rate;
  const double middle = q_.y() * x.sin1 - q_.z() * x.cos1 + r2 * inverse_r1_ * third;
  const double max_fourth_of_radial =
      r1 + (3 * r1 * r1 + 4 * v * v + 4 * p.max_rate * max_third_of_radial(p) +
            3 * p.max_second * p.max_second) *
               p.inverse_radial;
  const double max_fourth =
      std::sqrt(q_.y() * q_.y() + q_.z() * q_.z()) + r2 * inverse_r1_ * max_fourth_of_radial;
  const double rounding = 8 * p.rounding_of_curvature * (1 + r1 * p.inverse_radial);
  return std::abs(middle) + rounding + max_fourth * half_width;
}

Range Rims::cosines_at_height(double depth, double limit) const {
  const double lean = pair_.axes.s * pair_.r1, height = pair_.axes.along_u2(q_);
  const double lowest = end2_ > 0 ? -depth : -limit, highest = end2_ > 0 ? limit : depth;
  const double margin = 4 * noise();
  // Normals of opposite ends fill one quarter only, in which rim 1's points lie towards end 2.
  const bool whole = end1_ == end2_;
  const double min_cosine = whole || end2_ < 0 ? -1 : 0, max_cosine = whole || end2_ > 0 ? 1 : 0;
  return {std::max(min_cosine, (height - highest - margin) / lean),
          std::min(max_cosine, (height - lowest + margin) / lean)};
}

std::optional<Vec3> Rims::crossing_normal() const {
  constexpr double nearly_parallel = 0.1;
  const FoldedAxes& f = pair_.axes;
  if (f.s < nearly_parallel) return crossing_along_axes();
  // The equations at `useful_cosines` without the gap.
  const double c1 = f.along_u2(q_) / (f.s * pair_.r1), c2 = -q_.x() / (f.s * pair_.r2);
  if (!(std::abs(c1) <= 1 && std::abs(c2) <= 1)) return std::nullopt;
  return across_tangents(c1, sine_of(c1), c2, sine_of(c2));
}

// Across the axes the rims' points r1 a and r2 b then add up to q, two unit vectors of a triangle
// with known sides; and n lies from u1 in the direction of a, from u2 in that of b.
std::optional<Vec3> Rims::crossing_along_axes() const {
  const double r1 = pair_.r1, r2 = pair_.r2, y = q_.y(), z = q_.z();
  const double squared = y * y + z * z, length = std::sqrt(squared);
  const double along1 = (squared + (r1 - r2) * (r1 + r2)) / (2 * length);  // of r1 a, along q
  const double across_squared = (r1 - along1) * (r1 + along1);
  if (end1_ != end2_ || !(length > 0 && across_squared > 0)) return std::nullopt;
  // Of the two triangles the one with n3 > 0 on both ways.
  const double across = -end1_ * std::sqrt(across_squared), inverse = 1 / length;
  const double a2 = (along1 * y - across * z) * inverse, a3 = (along1 * z + across * y) * inverse;
  const double b3 = z - a3;
  if (!(a3 > 0 && b3 > 0)) return std::nullopt;
  const double way = pair_.axes.s * b3 / (std::abs(across) * length);
  return Vec3(end1_, way * a2, way * a3);
}

// Where the rims meet at a normal n with gap G, rim 1's point r1 (cos α e2 + sin α e3) and rim 2's
// r2 (cos β k2 + sin β e3) add up to q − G n. Along u2, e1 and e3 that is
//
//   s r1 cos α = q·u2 − G n·u2      s r2 cos β = G n·e1 − q·e1      r1 sin α + r2 sin β = d3 − G n3
//
// where n points outward at both ends, and n3 <= d3 / (r1 + r2 + G) because a rim's point is n's
// part across its axis, scaled up to the radius. At a maximum of depth δ = −G the tangents enclose
// an angle φ with cos² φ <= (1 − δ ρ1 / r1) (1 − δ ρ2 / r2), else the sum of the rims is less round
// than the sphere of that radius (the Hessian at `polished`; ρi is the sine of the angle between n
// and axis i). As ρ1 + ρ2 >= s, that product is at most what it is for the best such pair.
//
// Seen along e3, with e1 at 0 and u2 at γ, the signs of n·e2 and n·k2 and the ends say in which of
// the sectors between 0, γ, 90° and 90° + γ (or opposite ones) n lies, and so bound n·e1 and n·u2.
Range Rims::useful_cosines(double lowest, double highest) const {
  const FoldedAxes& f = pair_.axes;
  const double s = f.s, c = f.c, r1 = pair_.r1, r2 = pair_.r2;
  constexpr double parallel = 1e-2;
  if (s < parallel) return cosines_at_height(std::max(0.0, -lowest), std::max(0.0, highest));
  const double margin = 5e4 * noise(), inward = std::min(lowest, 0.0);
  const double outward = std::max(highest, 0.0);
  const double inverse1 = 1 / (s * r1), inverse2 = 1 / (s * r2);
  const double offset1 = f.along_u2(q_) * inverse1, offset2 = -q_.x() * inverse2;

  const double radii = r1 + r2;
  const double max_n3 = radii + lowest > 0 ? std::min(1.0, f.d3 / (radii + lowest)) : 1;
  const double in_plane = std::sqrt((1 - max_n3) * (1 + max_n3));
  const double bend = -std::min(highest, 0.0) * s;
  constexpr double rounding = 1e-12;
  const double max_squared_cosine =
      rounding +
      (r2 - bend >= r1 ? 1 - bend / r2 : (radii - bend) * (radii - bend) / (4 * r1 * r2));

  Range useful{2, -2};
  const auto keep_sector = [&](double sign1, double sign2, const Range& along1,
                               const Range& along2) {
    const Range gap2 = product(lowest, highest, along2);
    const Range cosine1 =
        cosines(offset1, -end2_ * inverse1, {gap2.lo - margin, gap2.hi + margin}, sign1);
    if (cosine1.empty()) return;
    const Range gap1 = product(lowest, highest, along1);
    const Range cosine2 =
        cosines(offset2, end1_ * inverse2, {gap1.lo - margin, gap1.hi + margin}, sign2);
    if (cosine2.empty()) return;
    Quarter one(cosine1), two(cosine2);
    const double n3 = std::min({max_n3, one.sine.hi, two.sine.hi});
    const Range sines{f.d3 - outward * n3 - margin, f.d3 - inward * n3 + margin};
    one.keep(s * inverse1 * (sines.lo - r2 * two.sine.hi),
             s * inverse1 * (sines.hi - r2 * two.sine.lo));
    two.keep(s * inverse2 * (sines.lo - r1 * one.sine.hi),
             s * inverse2 * (sines.hi - r1 * one.sine.lo));
    if (one.sine.empty() || two.sine.empty()) return;
    const double sines_lo = c * one.sine.lo * two.sine.lo;
    const double sines_hi = c * one.sine.hi * two.sine.hi;
    const double cosines_lo = one.cosine.lo * two.cosine.lo;
    const double cosine = sign1 == sign2 ? cosines_lo + sines_lo : cosines_lo - sines_hi;
    if (cosine > 0 && cosine * cosine > max_squared_cosine) return;
    useful.lo = std::min(useful.lo, sign1 > 0 ? one.cosine.lo : -one.cosine.hi);
    useful.hi = std::max(useful.hi, sign1 > 0 ? one.cosine.hi : -one.cosine.lo);
  };
  if (end1_ != end2_) {
    keep_sector(end2_, end2_, {0, s}, {0, s});
  } else {
    const Range near{c * in_plane, 1};  // between the axes
    keep_sector(end1_, end1_, {0, c}, {s * in_plane, 1});
    keep_sector(end1_, -end1_, near, near);
    keep_sector(-end1_, -end1_, {s * in_plane, 1}, {0, c});
  }
  return useful;
}

}  // namespace touchstone
