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
#include <array>
#include <utility>

#include "oracle/critical_direction.hpp"
#include "oracle/real_roots.hpp"

namespace touchstone::oracle {
namespace {

/// One choice of the segments' ends: both rims, and the cell of directions that belongs to it.
struct RimPair {
  Frame rim1;
  Frame rim2;
  IntegerVector q;           // reduced point times norm
  Integer radius1, radius2;  // units
  Integer norm;
  std::array<IntegerVector, 2> up;  // signed segment axes: up·n >= 0 in the cell
};

/// The rims at one angle, in balls; lengths in units.
class StationaryPair {
 public:
  StationaryPair(const RimPair& rims, const Ball& cosine, const Ball& sine);

  /// Appends the direction of every stationary point of rim 2 that rim 1's point has here.
  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) const;

 private:
  std::vector<BallVector> points_of_rim2(bool& undecided) const;
  void enclose(const BallVector& y, const BallDifference& difference,
               std::vector<DirectionBound>& out) const;
  bool may_be_in_cell(const BallVector& n, const BallVector& y) const;

  BallVector radial_, tangent_, w_, axis2_;
  Ball radius1_, radius2_;
  std::array<BallVector, 2> up_;
};

BallVector direction(const IntegerVector& v, const Ball& norm) {
  return {Ball(v.x) / norm, Ball(v.y) / norm, Ball(v.z) / norm};
}

StationaryPair::StationaryPair(const RimPair& rims, const Ball& cosine, const Ball& sine)
    : radius1_(rims.radius1), radius2_(rims.radius2) {
  const Ball norm(rims.norm);
  const BallVector e = direction(rims.rim1.e, norm), f = direction(rims.rim1.f, norm);
  radial_ = cosine * e + sine * f;
  tangent_ = cosine * f - sine * e;
  axis2_ = direction(rims.rim2.axis, norm);
  w_ = radius1_ * radial_ - direction(rims.q, norm);
  for (int i = 0; i < 2; ++i) {
    up_[i] = direction(rims.up[i], norm);
  }
}

std::vector<BallVector> StationaryPair::points_of_rim2(bool& undecided) const {
  undecided = false;
  std::vector<BallVector> points;
  const BallVector across = w_ - dot(w_, axis2_) * axis2_;
  const Ball across_length = norm(across);
  if (!across_length.contains_zero()) {
    const BallVector y = (radius2_ / across_length) * across;
    for (const BallVector& candidate : {y, -y}) {
      if (dot(w_ - candidate, tangent_).contains_zero()) points.push_back(candidate);
    }
    return points;
  }
  // On the axis of rim 2, or nearly: solve y·t1 = w·t1 within rim 2's plane.
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

/// False when it is certain that neither n nor −n is an outward normal of both rims' contacts.
bool StationaryPair::may_be_in_cell(const BallVector& n, const BallVector& y) const {
  const Ball signs[] = {dot(n, radial_), -dot(n, y), dot(n, up_[0]), dot(n, up_[1])};
  bool plus = true, minus = true;
  for (const Ball& s : signs) {
    if (s.is_negative()) plus = false;
    if (s.is_positive()) minus = false;
  }
  return plus || minus;
}

void StationaryPair::enclose(const BallVector& y, const BallDifference& difference,
                             std::vector<DirectionBound>& out) const {
  const BallVector apart = w_ - y;
  const Ball distance = norm(apart);
  // The tangents' cross product survives rims that touch, the difference parallel tangents.
  BallVector n = apart;
  if (arb_rel_accuracy_bits(distance.get()) < WorkingPrecision::bits() / 2) {
    const BallVector across = cross(tangent_, cross(axis2_, y));
    if (!norm(across).contains_zero()) n = across;
  }
  if (!norm(n).contains_zero()) {
    if (may_be_in_cell(n, y)) append_bounds(difference, n, out);
    return;
  }
  // The rims touch with parallel tangents, as far as this precision can tell: the gap is at most
  // their distance, if the two quarter circles of outward normals across the tangent meet at all.
  const BallVector inner = radial_ + up_[0];
  const BallVector outer = up_[1] - (Ball(1) / radius2_) * y;
  if (dot(inner, outer).is_negative()) return;
  out.push_back({distance - difference.inflation(), std::nullopt});
}

void StationaryPair::enclose(const BallDifference& difference,
                             std::vector<DirectionBound>& out) const {
  bool undecided = false;
  for (const BallVector& y : points_of_rim2(undecided)) enclose(y, difference, out);
  if (undecided) out.push_back({Ball(1) / Ball(0), std::nullopt});
}

class RimRimDirection : public CriticalDirection {
 public:
  RimRimDirection(const RimPair& rims, RealRoot t) : rims_(rims), t_(std::move(t)) {}

  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    const Ball t = t_.enclose();
    const Ball scale = Ball(1) / (Ball(1) + square(t));
    StationaryPair(rims_, (Ball(1) - square(t)) * scale, Ball(2) * t * scale)
        .enclose(difference, out);
  }

 private:
  RimPair rims_;
  RealRoot t_;
};

/// A rational point of rim 1: θ = π, or a sample of a whole family of stationary pairs.
class RimRimPoint : public CriticalDirection {
 public:
  RimRimPoint(const RimPair& rims, mpq_class cosine, mpq_class sine, bool of_a_continuum)
      : rims_(rims),
        cosine_(std::move(cosine)),
        sine_(std::move(sine)),
        of_a_continuum_(of_a_continuum) {}

  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    StationaryPair(rims_, Ball(cosine_), Ball(sine_)).enclose(difference, out);
  }
  bool of_a_continuum() const override { return of_a_continuum_; }

 private:
  RimPair rims_;
  mpq_class cosine_, sine_;
  bool of_a_continuum_;
};

/// α + β cos θ + γ sin θ times 1 + t².
Polynomial in_half_angle(const Integer& constant, const Integer& cosine, const Integer& sine) {
  return {Integer(constant + cosine), Integer(2 * sine), Integer(constant - cosine)};
}

// Every dot product of two vectors brings a factor norm² along, q·u2 and the like too; F is scaled
// by norm^8 and (1 + t²)⁴.
Polynomial stationary_octic(const RimPair& rims) {
  const Integer n2 = rims.norm * rims.norm;
  const Integer q_e = dot(rims.q, rims.rim1.e), q_f = dot(rims.q, rims.rim1.f);
  const Integer u_e = dot(rims.rim2.axis, rims.rim1.e), u_f = dot(rims.rim2.axis, rims.rim1.f);
  const Integer q_u = dot(rims.q, rims.rim2.axis);
  const Integer q_q = dot(rims.q, rims.q);
  const Integer& r1 = rims.radius1;

  const Polynomial one{1, 0, 1};
  const Polynomial q_t = in_half_angle(0, q_f, Integer(-q_e));  // norm² q·t1
  const Polynomial w_w =                                        // norm² |w|²
      in_half_angle(r1 * r1 * n2 + q_q, Integer(-2 * r1 * q_e), Integer(-2 * r1 * q_f));
  const Polynomial w_u = in_half_angle(Integer(-q_u), r1 * u_e, r1 * u_f);  // norm² w·u2
  const Polynomial u_t = in_half_angle(0, u_f, Integer(-u_e));              // norm² u2·t1

  const Polynomial across_squared = n2 * (w_w * one) - w_u * w_u;  // norm⁴ |w⊥|²
  const Polynomial across_t = n2 * (q_t * one) + w_u * u_t;        // −norm⁴ w⊥·t1
  return q_t * q_t * across_squared - Integer(rims.radius2 * rims.radius2) * (across_t * across_t);
}

/// Where rim 1's tangent is parallel to u2 and its point on rim 2's axis, F has a root without a
/// stationary pair of its own: either (w·t1 ≠ 0) none at all, or the whole of rim 2, whose normals
/// are all across u2 and belong to the line directions. Such points as t = tan(θ/2), exactly;
/// θ = π is reported by `at_infinity`.
std::vector<mpq_class> spurious_points(const RimPair& rims, bool& at_infinity) {
  at_infinity = false;
  std::vector<mpq_class> result;
  if (dot(rims.rim1.axis, rims.rim2.axis) != 0) return result;
  const IntegerVector radial = cross(rims.rim2.axis, rims.rim1.axis);  // of length norm²
  const Integer norm_cubed = rims.norm * rims.norm * rims.norm;
  for (const int sign : {1, -1}) {
    // p − q, times norm²
    const IntegerVector w = Integer(sign * rims.radius1) * radial - rims.norm * rims.q;
    const IntegerVector off_axis = cross(w, rims.rim2.axis);
    if (off_axis.x != 0 || off_axis.y != 0 || off_axis.z != 0) continue;
    const Integer cosine = sign * dot(radial, rims.rim1.e);
    const Integer sine = sign * dot(radial, rims.rim1.f);
    if (cosine == -norm_cubed) {
      at_infinity = true;
    } else {
      mpq_class t(sine, norm_cubed + cosine);
      t.canonicalize();
      result.push_back(t);
    }
  }
  return result;
}

void add_directions(const RimPair& rims, CriticalDirections& out) {
  const Polynomial octic = stationary_octic(rims);
  if (is_zero(octic)) {
    // A continuous family of stationary pairs, on which the distance is constant. Where it leaves
    // the cell it meets a direction of another kind; if it never does, any sample stands for it. At
    // most two points of rim 1 lie on rim 2's axis, so one of three samples shows both of rim 2's
    // points.
    const std::pair<mpq_class, mpq_class> samples[] = {
        {1, 0}, {mpq_class(3, 5), mpq_class(4, 5)}, {mpq_class(-5, 13), mpq_class(12, 13)}};
    for (const auto& [cosine, sine] : samples) {
      out.push_back(std::make_unique<RimRimPoint>(rims, cosine, sine, true));
    }
    return;
  }
  bool spurious_at_infinity = false;
  const std::vector<mpq_class> spurious = spurious_points(rims, spurious_at_infinity);
  if (octic.back() == 0 && !spurious_at_infinity) {
    out.push_back(std::make_unique<RimRimPoint>(rims, -1, 0, false));
  }
  for (auto& root : real_roots(octic)) {
    bool is_spurious = false;
    for (const auto& t : spurious) is_spurious = is_spurious || root.is(t);
    if (!is_spurious) out.push_back(std::make_unique<RimRimDirection>(rims, std::move(root)));
  }
}

}  // namespace

void add_rim_rim_directions(const Difference& difference, CriticalDirections& out) {
  if (difference.discs.size() != 2) return;
  // Two discs come with exactly the two segments of the same axes.
  const auto& [disc1, disc2] = std::pair(difference.discs[0], difference.discs[1]);
  for (unsigned signs = 0; signs < 4; ++signs) {
    RimPair rims{
        disc1.frame,     disc2.frame, reduced_point(difference, signs), disc1.radius, disc2.radius,
        difference.norm, {}};
    for (unsigned i = 0; i < 2; ++i) {
      const IntegerVector& axis = difference.segments[i].frame.axis;
      rims.up[i] = (signs >> i & 1U) ? axis : -axis;
    }
    add_directions(rims, out);
  }
}

}  // namespace touchstone::oracle
