#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "folded_axes.hpp"
#include "largest_gap.hpp"

namespace touchstone {

/// Two cylinders in their folded frame; the first has the smaller radius or the same.
struct FoldedCylinders {
  FoldedAxes axes;
  double r1, h1, r2, h2;

  /// g(n) of a unit n in the folded frame.
  double gap(const Vec3& n) const {
    const double m = axes.along_k2(n);
    return axes.d().dot(n) - h1 * std::abs(n.x()) - h2 * std::abs(axes.along_u2(n)) -
           r1 * std::sqrt(n.y() * n.y() + n.z() * n.z()) - r2 * std::sqrt(m * m + n.z() * n.z());
  }
  /// A clearance that is more than rounding.
  double clear_gap() const { return clear_part * lengths(); }
  /// What a proof leaves for the rounding of a point's place.
  double proof_rounding() const { return proof_part * lengths(); }
  /// All lengths together.
  double lengths() const {
    return axes.d3 + std::abs(axes.d2) + std::abs(axes.d1) + r1 + h1 + r2 + h2;
  }
  /// Where a point lies from a body's centre: along its axis, and the squared distance from that.
  struct FromAxis {
    double along, squared;
  };
  /// For n across axis 1: where B's support point lies from axis 1.
  FromAxis from_axis1(const Vec3& n) const {
    const double nu = axes.along_u2(n), m = axes.along_k2(n), end = std::copysign(h2, nu);
    const double rim = r2 / std::sqrt(m * m + n.z() * n.z());
    const double across = end * axes.s + rim * m * axes.c - axes.d2, off = rim * n.z() - axes.d3;
    return {end * axes.c - rim * nu * axes.c - axes.d1, across * across + off * off};
  }
  /// For n across axis 2: where A's support point lies from axis 2.
  FromAxis from_axis2(const Vec3& n) const {
    const Vec3 d = axes.d();
    const double end = std::copysign(h1, n.x());
    const double rim = r1 / std::sqrt(n.y() * n.y() + n.z() * n.z());
    const double across = axes.along_k2(d) + end * axes.s - rim * n.y() * axes.c;
    const double off = axes.d3 - rim * n.z();
    return {axes.along_u2(d) - end * axes.c + rim * n.x() * axes.c, across * across + off * off};
  }
  /// The largest gap between their shadows in the plane of the axes, which are rectangles.
  double gap_of_shadows() const {
    const double along_u2 = axes.c * axes.d1 + axes.s * axes.d2;
    const double along_k2 = axes.c * axes.d2 - axes.s * axes.d1;
    return std::max({std::abs(axes.d1) - h1 - h2 * axes.c - r2 * axes.s,
                     std::abs(along_u2) - h2 - h1 * axes.c - r1 * axes.s,
                     std::abs(axes.d2) - r1 - h2 * axes.s - r2 * axes.c,
                     std::abs(along_k2) - r2 - h1 * axes.s - r1 * axes.c});
  }
};

/// Of two cylinders: the best of the normals along either axis and across both.
struct CapsAndSides {
  double cap1, cap2, sides, gap;
  double side1, side2;  ///< ±1: whether cap 1 (2) has its normal along u1 (u2) or against it
  double c, s;

  CapsAndSides(const FoldedAxes& f, double r1, double h1, double r2, double h2) : c(f.c), s(f.s) {
    const double along2 = f.c * f.d1 + f.s * f.d2;
    cap1 = std::abs(f.d1) - h1 - h2 * f.c - r2 * f.s;
    cap2 = std::abs(along2) - h2 - h1 * f.c - r1 * f.s;
    sides = f.d3 - r1 - r2;
    gap = std::max(std::max(cap1, cap2), sides);
    side1 = std::copysign(1, f.d1), side2 = std::copysign(1, along2);
  }
  /// Branch-free: the winner is unpredictable.
  StageResult without_proof() const {
    const double is1 = gap == cap1 ? 1 : 0, is3 = gap == sides ? 1 - is1 : 0;
    const double is2 = side2 * (1 - is1 - is3);
    return {gap, side1 * is1 + is2 * c, is2 * s, is3};
  }
};

/// A point of rim 1 with the nearest point of rim 2.
struct RimSample {
  double angle;
  double slope;      ///< derivative of half the squared distance by the angle, over r1
  double curvature;  ///< derivative of the slope
  double distance;
  double radial, height;  ///< rim 1's point: distance from axis 2, height over rim 2's plane
  Vec3 apart;             ///< from rim 1's point to rim 2's
  double cos1, sin1, cos2, sin2;  ///< directions of the points, from e2 and from k2 towards e3
};

/// Bounds of rim 1's point on an arc as seen along axis 2, each per radian of its angle.
struct Passage {
  double min_speed, max_speed;
  double min_radial, max_radial;  ///< distance from axis 2
  // Valid where min_radial is positive:
  double inverse_radial;  ///< 1 / min_radial
  double turn;            ///< bound of the speed of turning about axis 2
  double rounding;        ///< of a slope or a difference of points, at most
  double rounding_of_curvature;
  double wave;        ///< the same for the squared distance from axis 2 of nearly concentric rims
  double max_rate;    ///< bound of the distance's first derivative
  double max_second;  ///< bound of its second derivative
};

struct Range {
  double lo, hi;
  bool empty() const { return !(lo <= hi); }
};

/// Where Newton's method for a normal of two rims ended.
struct Stationary {
  Vec3 normal;
  bool maximum;  ///< converged to a normal that points outward at both ends
  double slope;  ///< bound of the gap's derivative along the sphere there
};

/// One pair of rims, rim 1 about the origin and rim 2 about q. Bodies touch at these rims when q is
/// on the surface of their sum.
class Rims {
 public:
  Rims(const FoldedCylinders& pair, double end1, double end2)
      : pair_(pair), end1_(end1), end2_(end2) {
    const FoldedAxes& f = pair.axes;
    q_ = f.d() - end1 * pair.h1 * Vec3(1, 0, 0) - end2 * pair.h2 * Vec3(f.c, f.s, 0);
    size_ = pair.r1 + pair.r2 + q_.norm();
    margin_ = (margin_part + 2.5 * f.unit_error()) * size_;
    const double k = f.along_k2(q_), lean = f.s * pair.r1;
    amplitude_ = 2 * pair.r1 * std::sqrt(k * k + q_.z() * q_.z()) + 4 * lean * lean;
    inverse_r1_ = 1 / pair.r1;
  }

  RimSample at(double angle) const { return at(angle, std::cos(angle), std::sin(angle)); }
  RimSample at(double angle, double cosine, double sine) const {
    const double c = pair_.axes.c, s = pair_.axes.s, r1 = pair_.r1, r2 = pair_.r2;
    RimSample x;
    x.angle = angle;
    x.cos1 = cosine;
    x.sin1 = sine;
    const double v2 = q_.y() - r1 * x.cos1, v3 = q_.z() - r1 * x.sin1;
    const double height = c * q_.x() + s * v2, k = c * v2 - s * q_.x();
    const double radial = std::sqrt(k * k + v3 * v3);
    const double inverse = radial > 0 ? 1 / radial : 0;
    x.cos2 = radial > 0 ? k * inverse : 1;
    x.sin2 = v3 * inverse;
    const double beside = radial - r2;
    const double a_k = beside * x.cos2, a3 = beside * x.sin2;
    x.apart = Vec3(c * height - s * a_k, s * height + c * a_k, a3);
    x.distance = std::sqrt(height * height + beside * beside);
    x.radial = radial;
    x.height = height;
    x.slope = x.apart.y() * x.sin1 - a3 * x.cos1;
    // Rim 2's point moves by r1 r2 / radial times the part of rim 1's tangent along its own.
    const double follow = c * x.sin1 * x.sin2 + x.cos1 * x.cos2;
    const double moved = r2 * follow * follow * inverse;
    x.curvature = r1 * (1 - moved) + (x.apart.y() * x.cos1 + a3 * x.sin1);
    return x;
  }

  /// Newton's method for the stationary normal of these ends, about which
  /// G(n) = q·n − r1 |n − n·u1 u1| − r2 |n − n·u2 u2| is smooth. On the sphere G has the gradient
  /// q − p1 − p2 less its part along n, and the Hessian −(r1/ρ1) t1 t1ᵀ − (r2/ρ2) t2 t2ᵀ − G. The
  /// components of n that are small keep their digits. Of a step d, which puts the linear part to
  /// zero, the slope at n + d keeps the gradient's remainder alone: at most 0.58 |d|² r / ρ² of
  /// each rim, with the least ρ on the way. A step is at most half of n's distance from an axis,
  /// where G has its kinks; n that falls towards one which is a maximum itself, a cap's normal, is
  /// left there. Steps are few except where rims nearly touch along nearly parallel axes, in a
  /// valley that n has to go down by orders of magnitude.
  Stationary polished(Vec3 n, int steps = 40) const {
    const double c = pair_.axes.c, s = pair_.axes.s;
    double previous = std::numeric_limits<double>::infinity();
    bool converged = false;
    double slope = std::numeric_limits<double>::infinity();
    for (int i = 0; i < steps; ++i) {
      n *= 1 / n.norm();
      const double m = c * n.y() - s * n.x();  // n along k2
      const double rho1 = std::sqrt(n.y() * n.y() + n.z() * n.z());
      const double rho2 = std::sqrt(m * m + n.z() * n.z());
      const double inverse1 = 1 / rho1, inverse2 = 1 / rho2;
      const double k1 = pair_.r1 * inverse1, k2 = pair_.r2 * inverse2;
      const Vec3 residual(q_.x() + k2 * s * m, q_.y() - k1 * n.y() - k2 * c * m,
                          q_.z() - (k1 + k2) * n.z());
      const double value = residual.dot(n);
      const double y1 = -inverse1 * n.z(), z1 = inverse1 * n.y();
      const Vec3 t1(0, y1, z1), other(n.y() * z1 - n.z() * y1, -n.x() * z1, n.x() * y1);
      const Vec3 t2(inverse2 * s * n.z(), -inverse2 * c * n.z(), inverse2 * m);
      const double x = t2.dot(t1), y = t2.dot(other);
      const double a = k1 + k2 * x * x + value, b = k2 * x * y, e = k2 * y * y + value;
      const double determinant = a * e - b * b;
      if (!(a > 0 && determinant > 0)) break;  // NaN where n lies along an axis
      const double g1 = residual.dot(t1), g2 = residual.dot(other), inverse = 1 / determinant;
      slope = std::sqrt(g1 * g1 + g2 * g2);
      double step1 = (e * g1 - b * g2) * inverse, step2 = (a * g2 - b * g1) * inverse;
      const double gain = g1 * step1 + g2 * step2;
      const double length = std::sqrt(step1 * step1 + step2 * step2);
      const double max_length = std::min(rho1, rho2) / 2;
      const bool too_long = length > max_length;
      if (too_long) {
        constexpr double next_to = 0.1;
        if (max_length < next_to * pair_.axes.s && is_maximum_at_axis(n, rho1 < rho2)) break;
        step1 *= max_length / length, step2 *= max_length / length;
      }
      n += step1 * t1 + step2 * other;
      // Converged, or as far as rounding lets it. A short step alone says nothing: next to an axis
      // n may first turn about it by a hair and then leave it by far. What a whole step leaves of
      // the slope bounds the next one.
      constexpr double small_part = 1e-8, rounding = 1e-14;
      const double left = 3 * (k1 * inverse1 + k2 * inverse2) * length * length;
      const bool is_there = !too_long && left * (a + e) * inverse <= rounding * max_length;
      converged = is_there || length <= small_part * max_length;
      if (!too_long) slope = std::min(slope, left + noise());
      if (converged || (length >= previous / 2 && gain <= noise())) break;
      previous = too_long ? std::numeric_limits<double>::infinity() : length;
    }
    n.normalize();
    const bool outward = end1_ * n.x() >= 0 && end2_ * pair_.axes.along_u2(n) >= 0;
    return {n, converged && outward, slope};
  }

  /// Bound of the gap's derivative along the sphere at a unit n, rounding included.
  double slope_at(const Vec3& n) const {
    const Vec3 residual = between_points(n);
    return (residual - residual.dot(n) * n).norm() + margin_;
  }

  /// Whether G has a maximum at the axis that n leans away from, the first or the second: there the
  /// own rim holds its place against the slope of all else, which is as long as its radius at most.
  bool is_maximum_at_axis(const Vec3& n, bool first) const {
    const double c = pair_.axes.c, r1 = pair_.r1, r2 = pair_.r2;
    if (first) {
      const double y = q_.y() + std::copysign(c * r2, n.x());
      return y * y + q_.z() * q_.z() <= r1 * r1;
    }
    const double y = pair_.axes.along_k2(q_) - std::copysign(c * r1, pair_.axes.along_u2(n));
    return y * y + q_.z() * q_.z() <= r2 * r2;
  }

  /// Distance of the rims' points at a normal: the bodies are no further apart.
  double distance_at(const Vec3& n) const { return between_points(n).norm(); }

  /// Normal, of any length, across both rims' tangents where each of these rims crosses the other's
  /// cap. The rims meet there but for parts of the order of the gap.
  std::optional<Vec3> crossing_normal() const;

  /// Cosines of rim 1's angles at which these ends may have a local maximum of the gap between
  /// `lowest` and `highest`; an empty range if they have none.
  Range useful_cosines(double lowest, double highest) const;

  /// Whether the rims may meet with a largest gap on an arc. There n is `way` (+1 apart, −1
  /// overlapping) times `apart`, up to its length, has n3 >= 0, and points outward from both ends
  /// and both rims. It is also across both tangents, which tell more along nearly parallel axes.
  bool may_meet(const RimSample& x, double way, double half_width, const Passage& p) const {
    if (!(p.min_radial > 0)) return true;
    const double c = pair_.axes.c, moved = p.max_rate * half_width;
    const double turn = half_width * p.turn;  // of rim 2's point, at most
    const double slack = half_width + turn + margin_ * p.inverse_radial;
    const double error = pair_.axes.s * pair_.r1 * half_width + moved +
                         (std::abs(x.radial - pair_.r2) + moved) * turn + x.distance * half_width +
                         p.rounding;
    const double along1 = c * x.cos1 * x.sin2 - x.sin1 * x.cos2;
    const double along2 = x.cos1 * x.sin2 - c * x.sin1 * x.cos2;
    const double outward1 = x.apart.y() * x.cos1 + x.apart.z() * x.sin1;
    return x.sin2 >= -slack && end1_ * along1 >= -slack && end2_ * along2 >= -slack &&
           way * end1_ * x.apart.x() >= -error && way * end2_ * x.height >= -error &&
           way * x.apart.z() >= -error && way * outward1 >= -error &&
           way * (x.radial - pair_.r2) >= -error;
  }

  /// Vector across both rims' tangents at these places.
  Vec3 across_tangents(double cos1, double sin1, double cos2, double sin2) const {
    const double c = pair_.axes.c, s = pair_.axes.s;
    return {c * cos1 * sin2 - sin1 * cos2, s * cos1 * sin2, s * sin1 * sin2};
  }

  double radius1() const { return pair_.r1; }

  /// Bounds on the arc up to `half_width` from a sample (proofs.md, "The search of rims").
  Passage passage(const RimSample& x, double half_width) const {
    const double c = pair_.axes.c, r1 = pair_.r1;
    // The speed is the length of r1 (cos α, c sin α): between its larger component and their sum.
    const double one = std::abs(x.cos1), two = c * std::abs(x.sin1);
    Passage p;
    p.min_speed = r1 * (std::max(one, two) - half_width);
    p.max_speed = r1 * std::min(1.0, one + two + half_width);
    p.min_radial = x.radial - p.max_speed * half_width - margin_;
    p.max_radial = x.radial + p.max_speed * half_width + margin_;
    p.inverse_radial = 1 / p.min_radial;
    p.rounding = margin_ * (1 + 0.27 * pair_.r2 * p.inverse_radial);
    p.rounding_of_curvature = p.rounding * (1.12 + 2.8 * r1 * p.inverse_radial);
    p.turn = p.max_speed * p.inverse_radial;
    p.wave = amplitude_ * p.inverse_radial * p.inverse_radial;
    const double rate = r1 * std::abs(c * x.cos2 * x.sin1 - x.sin2 * x.cos1);
    const double wave_rate = p.min_radial * p.wave / 2;
    p.max_second = std::min(r1 + p.max_speed * p.turn, wave_rate * (1 + 0.5 * p.wave));
    p.max_rate = std::min({p.max_speed, wave_rate, rate + p.max_second * half_width});
    return p;
  }

  /// Bound of the slope's second derivative on an arc that stays off axis 2.
  double max_third_derivative(const RimSample& x, double half_width, const Passage& p) const {
    const double s = pair_.axes.s, r1 = pair_.r1;
    const double sine = std::min(0.5, std::abs(x.sin1) + half_width);
    const double height = std::abs(x.height) + s * r1 * half_width;
    const double beside = std::abs(x.radial - pair_.r2) + p.max_rate * half_width;
    return s * (height + 3 * s * r1 * sine) +
           (beside * max_third_of_radial(p) + 3 * p.max_rate * p.max_second) * inverse_r1_;
  }
  /// Bound of how far curvatures on the arc are from the middle's, rounding included; infinite
  /// where the arc may cross axis 2. It is closer, and takes longer, where distances hardly vary.
  double max_bend(const RimSample& x, double half_width, const Passage& p,
                  bool hardly_varies = false) const {
    if (!(p.min_radial > 0)) return std::numeric_limits<double>::infinity();
    double third = max_third_derivative(x, half_width, p);
    if (hardly_varies) third = std::min(third, max_third_derivative_of_short(x, half_width, p));
    return third * half_width + p.rounding_of_curvature;
  }

  /// Whether every stationary distance on the arc is a maximum, because rim 1 passes so close to
  /// axis 2 that rim 2's nearest point turns about it.
  bool has_only_maxima_beside_axis(const RimSample& x, double half_width, const Passage& p) const {
    const double s = pair_.axes.s, r1 = pair_.r1, r2 = pair_.r2;
    const double max_radial = p.max_radial, inside = r2 - max_radial;
    if (!(inside > 0 && p.min_speed > 0)) return false;
    const double max_height = std::abs(x.height) + s * r1 * half_width + margin_;
    const double max_rise = s * r1 * std::min(1.0, std::abs(x.sin1) + half_width);
    const double along = max_height * max_rise / inside;
    const double across_squared = p.min_speed * p.min_speed - along * along;
    return max_rise * max_rise + along * along + (s * max_height + r2) * r1 <
           inside * across_squared / max_radial;
  }

  /// Whether n points inward at end 1 wherever the rims of overlapping bodies meet on the arc.
  /// There `apart` is −δ n, and along axis 1 only rim 2's point moves, by s r2 dβ.
  bool points_inward(const RimSample& middle, double half_width, const Passage& p) const {
    const double change = pair_.axes.s * pair_.r2 * p.turn * half_width;
    return p.min_radial > 0 && end1_ * middle.apart.x() > change + p.rounding;
  }

  /// What rounding mostly leaves of a slope, or of a length.
  double noise() const { return 2e-16 * size_; }
  /// Bound of what `at` rounds a slope, a curvature and a difference of points, where the rim is
  /// not next to axis 2: `Passage::rounding` is it where it is (proofs.md, "Rounding of a certified
  /// distance").
  double margin() const { return margin_; }
  /// Bound of what it rounds a distance.
  double distance_rounding() const { return margin_ / 2; }

 private:
  /// From rim 2's point at a normal to rim 1's.
  Vec3 between_points(const Vec3& n) const {
    const double c = pair_.axes.c, s = pair_.axes.s, m = c * n.y() - s * n.x();
    const double k1 = pair_.r1 / std::sqrt(n.y() * n.y() + n.z() * n.z());
    const double k2 = pair_.r2 / std::sqrt(m * m + n.z() * n.z());
    return {q_.x() + k2 * s * m, q_.y() - k1 * n.y() - k2 * c * m, q_.z() - (k1 + k2) * n.z()};
  }

  /// `crossing_normal` of nearly parallel axes, where the rims cross as seen along the axes.
  std::optional<Vec3> crossing_along_axes() const;

  /// Useful cosines from one coordinate alone, which is all that rounding leaves of them along
  /// nearly parallel axes. Rim 1's point lies above rim 2's plane by a height that its angle gives,
  /// at most the distance of the rims, on the far side of the plane where the bodies are apart, on
  /// the near side where they overlap.
  Range cosines_at_height(double depth, double limit) const;

  /// `max_third_derivative` by what the third derivative is in the middle and how far it changes:
  /// its terms cancel where the distance hardly varies. It pays on short arcs only.
  double max_third_derivative_of_short(const RimSample& x, double half_width,
                                       const Passage& p) const;
  /// Bound of the third derivative of rim 1's point's distance from axis 2.
  double max_third_of_radial(const Passage& p) const {
    return std::min(p.max_speed * (1 + 1.155 * p.turn * p.turn) + 3 * pair_.r1 * p.turn,
                    p.min_radial * p.wave * (0.5 + p.wave * (0.75 + 0.375 * p.wave)));
  }

  const FoldedCylinders& pair_;
  static constexpr double margin_part = 34 * unit_roundoff;  // proofs.md

  double end1_, end2_;
  Vec3 q_;
  double size_, margin_;
  double amplitude_;  ///< bound of each derivative of the squared distance of rim 1 from axis 2
  double inverse_r1_;
};

/// Offers `best` the normals at which the rims of two cylinders meet, wherever one of them may have
/// a larger gap; stops as soon as the gap exceeds `stop_above`.
///
/// The best normal so far tells which ends' rims are likely to meet. Newton's method from where
/// these cross, or along two points that face each other, mostly ends at a maximum that proves
/// itself the largest (deep_normals.hpp). Else, of each pair of ends, the arc of the smaller rim is
/// found where a maximum can lie at all (Rims::useful_cosines); mostly there is none. That arc is
/// searched to the end (RimScan).
void offer_rim_rim_normals(const FoldedCylinders& pair, double stop_above, LargestGap& best);

/// Searches the rims of all four pairs of ends, whatever is known of them. Returns by how much the
/// largest gap where rims meet may exceed the best one at most, rounding of the search included.
double search_all_rims(const FoldedCylinders& pair, LargestGap& best);

/// Whether rims meet at the best normal in a way that proves it the largest gap of all, but for
/// rounding.
bool is_proven_where_rims_meet(const FoldedCylinders& pair, const LargestGap& best);

}  // namespace touchstone
