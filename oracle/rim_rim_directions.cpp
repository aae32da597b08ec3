// Rim against rim: the stationary distances of two circles in space, an octic (Neff, "Finding the
// distance between two circles in three-dimensional space", IBM J. Res. Dev. 34, 1990).
//
// Circle 1 is p(θ) = radius1 (cos θ e + sin θ f) about the origin; circle 2 has the centre q and
// the axis u2. With the tangent t1 = −sin θ e + cos θ f and w = p − q, the points y of circle 2
// that are stationary for p are ±radius2 w⊥/|w⊥| (w⊥ across u2, relative to q), and p is stationary
// for y where (w − y)·t1 = 0. Squared, with w·t1 = −q·t1:
//
//   F(θ) = (q·t1)² |w⊥|² − radius2² (w⊥·t1)² = 0,
//
// of degree 8 in t = tan(θ/2). F also vanishes where p lies on circle 2's axis (w⊥ = 0); there y
// follows from y·t1 = w·t1, which every stationary pair satisfies.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "oracle/critical_direction.hpp"
#include "oracle/real_roots.hpp"
#include "oracle/slope_root.hpp"

namespace touchstone::oracle {
namespace {

/// Both rims for one choice of the segments' ends, and the cell of directions that belongs to that
/// choice.
struct RimPair {
  /// Whose roots are the angles of rim 1 with stationary pairs, of both branches.
  Polynomial polynomial() const;
  /// Times norm².
  RimSlope<Ball> slope(int branch) const;
  static std::optional<Ball> stretch() { return std::nullopt; }
  /// norm² w·u2 and norm² |w|², of rim 1's point relative to rim 2's centre.
  Polynomial height() const;
  Polynomial distance_squared() const;

  Frame rim1;
  Frame rim2;
  IntegerVector q;           // reduced point times norm
  Integer radius1, radius2;  // units
  Integer norm;
  unsigned signs;  // of the segments: their axes' sides in the cell
};

/// Rim 1's point at one angle and its stationary partners on rim 2, in balls; lengths in units.
class StationaryPair {
 public:
  StationaryPair(const RimPair& rims, const BallDifference& difference, const Angle<Ball>& angle);

  /// Appends the directions to all points of rim 2 that are stationary for rim 1's point; those of
  /// one branch alone if it is not 0.
  void enclose(int branch, std::vector<DirectionBound>& out) const;

  /// Is the common normal outward for both rims? Precondition: rim 1's point lies on rim 2.
  bool touches_outward() const;

 private:
  std::vector<BallVector> points_of_rim2(int branch, bool& undecided) const;
  void enclose(const BallVector& y, std::vector<DirectionBound>& out) const;
  /// Is n an outward normal of both rims at their points?
  Certainty is_outward(const BallVector& n, const BallVector& y) const;

  const BallDifference& difference_;
  BallVector radial_, tangent_, w_, axis2_;
  Ball radius1_, radius2_;
  std::array<BallVector, 2> up_;
};

StationaryPair::StationaryPair(const RimPair& rims, const BallDifference& difference,
                               const Angle<Ball>& angle)
    : difference_(difference),
      axis2_(difference.axis(1)),
      radius1_(rims.radius1, WorkingPrecision::bits()),
      radius2_(rims.radius2, WorkingPrecision::bits()) {
  const Ball inverse_norm = Ball(1) / Ball(rims.norm, WorkingPrecision::bits());
  const auto unit = [&](const IntegerVector& v) { return inverse_norm * to_balls(v); };
  const BallVector e = unit(rims.rim1.e), f = unit(rims.rim1.f);
  radial_ = angle.cosine * e + angle.sine * f;
  tangent_ = angle.cosine * f - angle.sine * e;
  w_ = radius1_ * radial_ - unit(rims.q);
  for (unsigned i = 0; i < 2; ++i) {
    up_[i] = (rims.signs >> i & 1U) ? difference.axis(i) : -difference.axis(i);
  }
}

std::vector<BallVector> StationaryPair::points_of_rim2(int branch, bool& undecided) const {
  undecided = false;
  std::vector<BallVector> points;
  const BallVector across = w_ - dot(w_, axis2_) * axis2_;
  const Ball across_length = norm(across);
  if (!across_length.contains_zero()) {
    const BallVector y = (radius2_ / across_length) * across;
    if (branch != 0) return {branch > 0 ? y : -y};
    for (const BallVector& candidate : {y, -y}) {
      if (dot(w_ - candidate, tangent_).contains_zero()) points.push_back(candidate);
    }
    return points;
  }
  // On rim 2's axis, or nearly so: solve y·t1 = w·t1 in rim 2's plane.
  const BallVector slope = tangent_ - dot(tangent_, axis2_) * axis2_;
  const Ball slope_squared = dot(slope, slope);
  if (slope_squared.contains_zero()) {
    undecided = true;
    return points;
  }
  const Ball along = dot(w_, tangent_);
  const Ball rest_squared = square(radius2_) - square(along) / slope_squared;
  if (rest_squared.is_negative()) return points;
  const BallVector foot = (along / slope_squared) * slope;
  const BallVector side = sqrt(rest_squared / slope_squared) * cross(axis2_, slope);
  points.push_back(foot + side);
  points.push_back(foot - side);
  return points;
}

Certainty StationaryPair::is_outward(const BallVector& n, const BallVector& y) const {
  const Ball signs[] = {dot(n, radial_), -dot(n, y), dot(n, up_[0]), dot(n, up_[1])};
  Certainty side = Certainty::yes;
  for (const Ball& s : signs) {
    if (s.is_negative()) return Certainty::no;
    if (!s.is_positive()) side = Certainty::undecided;
  }
  return side;
}

void StationaryPair::enclose(const BallVector& y, std::vector<DirectionBound>& out) const {
  const BallVector apart = w_ - y;
  const Ball distance = norm(apart);
  // For touching rims the cross product of the tangents is well defined, for parallel tangents the
  // difference of the points is.
  BallVector n = apart;
  if (distance.contains_zero() ||
      arb_rel_accuracy_bits(distance.get()) < WorkingPrecision::bits() / 2) {
    const BallVector across = cross(tangent_, cross(axis2_, y));
    if (!norm(across).contains_zero()) n = across;
  }
  if (norm(n).contains_zero()) {
    // At this precision the rims may touch with parallel tangents. Then the gap of what is not
    // inflated is at most their distance, if the two quarter circles of outward normals intersect
    // at all.
    const BallVector inner = radial_ + up_[0];
    const BallVector outer = up_[1] - (Ball(1) / radius2_) * y;
    if (!dot(inner, outer).is_negative()) {
      out.push_back({distance - difference_.inflation(), std::nullopt});
    }
    return;
  }
  if (is_outward(n, y) != Certainty::no) out.push_back({difference_.gap(n), n});
  if (is_outward(-n, y) != Certainty::no) out.push_back({difference_.gap(-n), -n});
}

void StationaryPair::enclose(int branch, std::vector<DirectionBound>& out) const {
  bool undecided = false;
  for (const BallVector& y : points_of_rim2(branch, undecided)) enclose(y, out);
  if (undecided) out.push_back({Ball(1) / Ball(0), std::nullopt});
}

bool StationaryPair::touches_outward() const {
  const BallVector n = cross(tangent_, cross(axis2_, w_));
  return is_outward(n, w_) == Certainty::yes || is_outward(-n, w_) == Certainty::yes;
}

/// (1 + t²)(α + β cos θ + γ sin θ) as a polynomial in t = tan(θ/2).
Polynomial in_half_angle(const Integer& constant, const Integer& cosine, const Integer& sine) {
  return {Integer(constant + cosine), Integer(2 * sine), Integer(constant - cosine)};
}

Polynomial RimPair::height() const {
  return in_half_angle(Integer(-dot(q, rim2.axis)), radius1 * dot(rim2.axis, rim1.e),
                       radius1 * dot(rim2.axis, rim1.f));
}

Polynomial RimPair::distance_squared() const {
  return in_half_angle(radius1 * radius1 * norm * norm + dot(q, q),
                       Integer(-2 * radius1 * dot(q, rim1.e)),
                       Integer(-2 * radius1 * dot(q, rim1.f)));
}

// Every dot product of two vectors carries a factor norm²; F is scaled by norm^8 (1 + t²)⁴.
Polynomial RimPair::polynomial() const {
  const Integer n2 = norm * norm;
  const Integer q_e = dot(q, rim1.e), q_f = dot(q, rim1.f);
  const Integer u_e = dot(rim2.axis, rim1.e), u_f = dot(rim2.axis, rim1.f);
  const Polynomial one{1, 0, 1};
  const Polynomial q_t = in_half_angle(0, q_f, Integer(-q_e));  // norm² q·t1
  const Polynomial w_u = height();
  const Polynomial u_t = in_half_angle(0, u_f, Integer(-u_e));  // norm² u2·t1

  const Polynomial across_squared = n2 * (distance_squared() * one) - w_u * w_u;  // norm⁴ |w⊥|²
  const Polynomial across_t = n2 * (q_t * one) + w_u * u_t;  // −norm⁴ w⊥·t1
  return q_t * q_t * across_squared - Integer(radius2 * radius2) * (across_t * across_t);
}

RimSlope<Ball> RimPair::slope(int branch) const {
  const auto ball = [](const Integer& x) { return Ball(x, WorkingPrecision::bits()); };
  const auto place = [&](const IntegerVector& axis) -> RimSlope<Ball>::Place {
    return {ball(-dot(q, axis)),
            {ball(radius1 * dot(rim1.e, axis)), ball(radius1 * dot(rim1.f, axis))}};
  };
  return {{ball(-dot(q, rim1.f)), ball(dot(q, rim1.e))},
          place(rim2.e),
          place(rim2.f),
          ball(branch * radius2) / ball(radius1),
          0};
}

/// Exact t = tan(θ/2) of the spurious roots of F: where rim 1's tangent is parallel to u2 and its
/// point lies on rim 2's axis. If w·t1 ≠ 0 there is no stationary pair; otherwise every point of
/// rim 2 is stationary, with a normal perpendicular to u2, which the line directions cover. θ = π
/// is left out because no site lies there.
std::vector<mpq_class> spurious_points(const RimPair& rims) {
  std::vector<mpq_class> result;
  if (dot(rims.rim1.axis, rims.rim2.axis) != 0) return result;
  const IntegerVector radial = cross(rims.rim2.axis, rims.rim1.axis);  // of length norm²
  const Integer norm_cubed = rims.norm * rims.norm * rims.norm;
  for (const int sign : {1, -1}) {
    // p − q, times norm²
    const IntegerVector w = Integer(sign * rims.radius1) * radial - rims.norm * rims.q;
    const IntegerVector off_axis = cross(w, rims.rim2.axis);
    if (!is_zero(off_axis)) continue;
    const Integer cosine = sign * dot(radial, rims.rim1.e);
    const Integer sine = sign * dot(radial, rims.rim1.f);
    if (cosine == -norm_cubed) continue;
    mpq_class t(sine, norm_cubed + cosine);
    t.canonicalize();
    result.push_back(t);
  }
  return result;
}

class RimRimDirection : public CriticalDirection {
 public:
  RimRimDirection(const RimPair& rims, CurveRoot t, bool of_a_family)
      : rims_(rims), t_(std::move(t)), of_a_family_(of_a_family) {}

  void enclose(const Difference&, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    pair(balls).enclose(t_.branch(), out);
  }

  // Touching rims share a point of both bodies, so that no gap is above zero. Rims of rounded
  // bodies touch nothing.
  ZeroGap zero_gap(const Difference& difference) override {
    if (difference.inflation != 0) return ZeroGap::unknown;
    // Rim 1's point lies on rim 2: in its plane, and at its radius.
    const Integer radius_squared = rims_.norm * rims_.norm * rims_.radius2 * rims_.radius2;
    const Polynomial beyond = rims_.distance_squared() - radius_squared * Polynomial{1, 0, 1};
    if (!t_.is_root_of(rims_, rims_.height()) || !t_.is_root_of(rims_, beyond)) {
      return ZeroGap::unknown;
    }
    const BallDifference balls(difference);
    return pair(balls).touches_outward() ? ZeroGap::zero : ZeroGap::at_most_zero;
  }

  // A direction perpendicular to an axis also belongs to that axis's line directions.
  bool is_across(const IntegerVector&) override { return false; }

  std::optional<DirectionFamily> family() const override {
    if (!of_a_family_) return std::nullopt;
    return DirectionFamily{NormalFamily::Kind::curve, {0, 0, 0}, {}};
  }

 private:
  StationaryPair pair(const BallDifference& balls) {
    return {rims_, balls, angle_of(AngleParameter::half_tangent, t_.enclose(rims_))};
  }

  RimPair rims_;
  CurveRoot t_;
  bool of_a_family_;
};

/// A known root as a RealRoot.
RealRoot rational_root(const mpq_class& t) {
  return RealRoot({Integer(-t.get_num()), t.get_den()}, t, t);
}

}  // namespace

void append_rim_rim(const Difference& difference, const CriticalSite& site,
                    CriticalDirections& out) {
  // With two discs the segments are exactly two, with the same axes.
  const auto& [disc1, disc2] = std::pair(difference.discs[0], difference.discs[1]);
  RimPair rims{disc1.frame,  disc2.frame,  reduced_point(difference, site),
               disc1.radius, disc2.radius, difference.norm,
               site.signs};
  if (site.turn == 1) {
    rims.rim1.e = -rims.rim1.e;
    rims.rim1.f = -rims.rim1.f;
  }
  if (site.branch != 0) {
    const SlopeBracket bracket{site.lo, site.hi, site.branch, site.rising};
    out.push_back(std::make_unique<RimRimDirection>(rims, CurveRoot(bracket), false));
    return;
  }
  const mpq_class lo(site.lo), hi(site.hi);
  const Polynomial octic = rims.polynomial();
  const std::vector<mpq_class> spurious = spurious_points(rims);
  if (is_zero(octic)) {
    // A continuous family of stationary pairs at constant distance. Where it leaves the cell it
    // meets a direction of another kind; if it does not leave it, any sample represents it. At most
    // two points of rim 1 lie on rim 2's axis, so that one of several samples yields both points of
    // rim 2.
    for (int i = 1; i <= 5; ++i) {
      const mpq_class t = lo + mpq_class(i, 6) * (hi - lo);
      if (std::find(spurious.begin(), spurious.end(), t) != spurious.end()) continue;
      out.push_back(std::make_unique<RimRimDirection>(rims, rational_root(t), true));
    }
    return;
  }
  for (auto& root : real_roots(octic, lo, hi)) {
    bool is_spurious = false;
    for (const auto& t : spurious) is_spurious = is_spurious || root.is(t);
    if (!is_spurious) {
      out.push_back(std::make_unique<RimRimDirection>(rims, std::move(root), false));
    }
  }
}

}  // namespace touchstone::oracle
