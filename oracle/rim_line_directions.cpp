// A rim against a side or an edge: directions perpendicular to a line. In the projection along that
// line the disc is an ellipse, all else a point or a disc. The nearest point of an ellipse is a
// root of a quartic: Ericson, "Real-Time Collision Detection"; Eberly, "Distance from a Point to an
// Ellipse".
//
// With n = e + t f for orthonormal e, f perpendicular to the line, n' = f − t e, the disc's unit
// axis u and the reduced point q, the gap is stationary where
//
//   (q·n')² (n·n − (u·n)²) = radius² (u·n)² (u·n')².
#include <utility>

#include "oracle/critical_direction.hpp"
#include "oracle/real_roots.hpp"

namespace touchstone::oracle {
namespace {

/// The frame with e and f turned by that many quarter turns about its axis.
Frame turned(const Frame& frame, unsigned quarters) {
  switch (quarters) {
    case 0:
      return frame;
    case 1:
      return {frame.axis, frame.f, -frame.e};
    case 2:
      return {frame.axis, -frame.e, -frame.f};
    default:
      return {frame.axis, -frame.f, frame.e};
  }
}

/// The data of the gap along directions perpendicular to one line, at one vertex of the other
/// segments.
struct Profile {
  Frame line;
  const Difference::Segment* segment;
  unsigned signs;
  IntegerVector q;
  Frame disc;
  Integer radius;
  Integer flat;  ///< the inflation plus the radius of a disc perpendicular to the line

  /// v·n as a polynomial in t.
  Polynomial along(const IntegerVector& v) const { return {dot(v, line.e), dot(v, line.f)}; }
  Polynomial across(const IntegerVector& v) const {
    return {dot(v, line.f), Integer(-dot(v, line.e))};
  }
};

/// norm⁴ n·n
Polynomial length_squared(const Integer& norm) {
  const Integer norm_squared = norm * norm;
  const Integer norm_fourth = norm_squared * norm_squared;
  return {norm_fourth, 0, norm_fourth};
}

// Scale factors: q by norm², u·n by norm², both sides by norm⁸.
Polynomial stationary_quartic(const Profile& profile, const Integer& norm) {
  const Polynomial q_slope = profile.across(profile.q);
  const Polynomial u_n = profile.along(profile.disc.axis);
  const Polynomial u_slope = profile.across(profile.disc.axis);
  const Polynomial u_part = u_n * u_n;
  return q_slope * q_slope * (length_squared(norm) - u_part) -
         Integer(profile.radius * profile.radius) * (u_part * (u_slope * u_slope));
}

class RimLineDirection : public CriticalDirection {
 public:
  RimLineDirection(Profile profile, RealRoot t) : profile_(std::move(profile)), t_(std::move(t)) {}

  void enclose(const Difference& difference, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = direction();
    if (at_vertex(difference, profile_.signs, n, profile_.segment) == Side::no) return;
    out.push_back({balls.gap(n), n});
  }

  // q·n − radius |u × n| − flat |n|, times norm².
  ZeroGap zero_gap(const Difference& difference) override {
    const Polynomial a = profile_.along(profile_.q);
    const Polynomial u_n = profile_.along(profile_.disc.axis);
    const Polynomial n_n = length_squared(difference.norm);
    const Polynomial b = Integer(profile_.radius * profile_.radius) * (n_n - u_n * u_n);
    const Polynomial c = Integer(profile_.flat * profile_.flat) * n_n;
    if (!is_zero_here(a, b, c)) return ZeroGap::unknown;
    return at_vertex(difference, profile_.signs, direction(), profile_.segment) == Side::yes
               ? ZeroGap::zero
               : ZeroGap::at_most_zero;
  }

  bool is_across(const IntegerVector& v) const override {
    const Integer constant = dot(v, profile_.line.e), slope = dot(v, profile_.line.f);
    if (slope == 0) return constant == 0;
    mpq_class t(Integer(-constant), slope);
    t.canonicalize();
    return t_.is(t);
  }

 private:
  /// Is a − √b − √c zero at this root?
  bool is_zero_here(const Polynomial& a, const Polynomial& b, const Polynomial& c) {
    if (t_.is_root_of(b)) {
      // The direction is the disc's axis.
      return is_zero(c) ? t_.is_root_of(a) : is_zero_here(a, c, {0});
    }
    if (!t_.is_root_of(root_sum_norm(a, b, c))) return false;
    const Ball t = t_.enclose();
    return has_no_other_zero(value_at(a, t), value_at(b, t), value_at(c, t));
  }

  BallVector direction() {
    return to_balls(profile_.line.e) + t_.enclose() * to_balls(profile_.line.f);
  }

  Profile profile_;
  RealRoot t_;
};

}  // namespace

void append_rim_line(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out) {
  const auto& segment = difference.segments[site.first];
  const auto& disc = difference.discs[site.second];
  Integer flat = difference.inflation;
  for (const auto& other : difference.discs) {
    if (&other != &disc) flat += other.radius;
  }
  Profile profile{turned(segment.frame, site.turn),
                  &segment,
                  site.signs,
                  reduced_point(difference, site.signs, &segment),
                  disc.frame,
                  disc.radius,
                  std::move(flat)};
  const Polynomial quartic = stationary_quartic(profile, difference.norm);
  if (is_zero(quartic)) {
    // The line lies in the disc's plane, and the end of the projected disc coincides with the
    // reduced point (or its mirror image does): the gap is constant over all directions of that
    // end's normal cone.
    std::vector<IntegerVector> inward = signed_axes(difference, site.signs, &segment);
    inward.push_back(off_axis(profile.q, profile.line));
    DirectionFamily arc = sector(profile.line.axis, inward);
    if (!arc.ends.empty()) {
      const IntegerVector end = arc.ends.front();
      out.push_back(rational_direction(end, std::move(arc)));
    }
    return;
  }
  for (auto& root : real_roots(quartic, mpq_class(site.lo), mpq_class(site.hi))) {
    out.push_back(std::make_unique<RimLineDirection>(profile, std::move(root)));
  }
}

}  // namespace touchstone::oracle
