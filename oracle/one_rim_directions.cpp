// Critical directions with one disc: those with closed forms, which are rational or need one square
// root, and those of a rim against a side or an edge.
#include <utility>

#include "oracle/critical_direction.hpp"
#include "oracle/real_roots.hpp"
#include "oracle/slope_root.hpp"

namespace touchstone::oracle {
namespace {

/// From the nearest point of a rim (about the origin) to a vertex q: n = q − radius · q⊥/|q⊥|.
class RimVertexDirection : public CriticalDirection {
 public:
  RimVertexDirection(IntegerVector q, std::vector<IntegerVector> inward,
                     const Integer& radius_times_norm, IntegerVector across)
      : q_(std::move(q)),
        inward_(std::move(inward)),
        radius_(radius_times_norm),
        across_(std::move(across)) {}

  void enclose(const Difference&, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = direction();
    // Outside the rim no direction is zero, although its ball may contain zero at this precision.
    if (at_vertex(inward_, n) != Certainty::no) out.push_back({balls.gap(n), n});
  }

  // |n| = inflation, that is |q|² + radius² − inflation² = 2 radius |q⊥|.
  ZeroGap zero_gap(const Difference& difference) override {
    const Integer inflation = difference.inflation * difference.norm;
    const Integer rest = dot(q_, q_) + radius_ * radius_ - inflation * inflation;
    const Integer norm_squared = difference.norm * difference.norm;
    if (rest < 0 || rest * rest * norm_squared * norm_squared !=
                        4 * radius_ * radius_ * dot(across_, across_)) {
      return ZeroGap::unknown;
    }
    return at_vertex(inward_, direction()) == Certainty::yes ? ZeroGap::zero
                                                             : ZeroGap::at_most_zero;
  }

  // n·v = q·v − radius (across·v) / |across|
  bool is_across(const IntegerVector& v) override {
    const Integer whole = dot(q_, v), part = radius_ * dot(across_, v);
    return sgn(whole) == sgn(part) && whole * whole * dot(across_, across_) == part * part;
  }

 private:
  BallVector direction() const {
    const BallVector across = to_balls(across_);
    return to_balls(q_) - (Ball(radius_) / norm(across)) * across;
  }

  IntegerVector q_;
  std::vector<IntegerVector> inward_;
  Integer radius_;
  IntegerVector across_;  // norm² q⊥, not zero
};

// A rim against a side or an edge: directions perpendicular to a line. In the projection along that
// line the disc is an ellipse, all else a point or a disc. The nearest point of an ellipse is a
// root of a quartic: Ericson, "Real-Time Collision Detection"; Eberly, "Distance from a Point to an
// Ellipse".
//
// With n = e + t f for orthonormal e, f perpendicular to the line, n' = f − t e, the disc's unit
// axis u and the reduced point q, the gap is stationary where
//
//   (q·n')² (n·n − (u·n)²) = radius² (u·n)² (u·n')².
//
// The length of a hull's edge is irrational, so that no e and f of rational coordinates have one
// length. The polynomial is then that of t |e|/|f|, with n' = |e|² f − t |f|² e.

/// The frame with e and f turned by that many quarter turns about its axis: the first takes e to f
/// and f to −e.
Frame turned(const Frame& frame, unsigned quarters) {
  auto [f, e] = turned(frame.f, frame.e, quarters);
  return {frame.axis, std::move(e), std::move(f)};
}

/// The gap along directions perpendicular to one line, at one vertex of the other segments.
struct Profile {
  /// Whose roots are the critical directions of both branches.
  Polynomial polynomial() const;
  /// Times norm |f|.
  LineSlope<Ball> slope(int branch) const;
  /// norm² n·n
  Polynomial length_squared() const {
    return {Integer(norm * norm * squared(line.e)), 0, Integer(norm * norm * squared(line.f))};
  }
  /// |f|/|e|, unless it is 1.
  std::optional<Ball> stretch() const {
    if (!is_edge) return std::nullopt;
    return relative_length(line.e);
  }

  Integer norm;
  Frame line;  ///< of any length; all of one, unless it is an edge of a hull
  bool is_edge;
  std::vector<IntegerVector> inward;
  IntegerVector q;
  Frame disc;
  Integer radius;
  Integer flat;  ///< the inflation plus the radius of a disc perpendicular to the line

  /// v·n as a polynomial in t.
  Polynomial along(const IntegerVector& v) const { return {dot(v, line.e), dot(v, line.f)}; }
  /// v·n'
  Polynomial across(const IntegerVector& v) const {
    if (!is_edge) return {dot(v, line.f), Integer(-dot(v, line.e))};
    return {Integer(squared(line.e) * dot(v, line.f)), Integer(-squared(line.f) * dot(v, line.e))};
  }

  static Integer squared(const IntegerVector& v) { return dot(v, v); }
  /// Of f to this direction.
  Ball relative_length(const IntegerVector& v) const {
    const long bits = WorkingPrecision::bits();
    return sqrt(Ball(squared(line.f), bits) / Ball(squared(v), bits));
  }
};

// Scale factors: q and u by norm, and so both sides by its fourth power.
Polynomial Profile::polynomial() const {
  const Polynomial q_slope = across(q);
  const Polynomial u_n = along(disc.axis);
  const Polynomial u_slope = across(disc.axis);
  const Polynomial u_part = u_n * u_n;
  return q_slope * q_slope * (length_squared() - u_part) -
         Integer(radius * radius) * (u_part * (u_slope * u_slope));
}

LineSlope<Ball> Profile::slope(int branch) const {
  const auto ball = [](const Integer& x) { return Ball(x, WorkingPrecision::bits()); };
  const std::optional<Ball> longer = stretch();
  const auto harmonic = [&](const IntegerVector& v) {
    const Ball sine = ball(-dot(v, line.e));
    return Harmonic<Ball>{ball(dot(v, line.f)), longer ? *longer * sine : sine};
  };
  const Integer exact = dot(disc.axis, line.axis);
  Ball along_line = ball(exact);
  if (longer) along_line = along_line * relative_length(line.axis);
  return {harmonic(q), harmonic(disc.axis), along_line, ball(branch * radius), exact == 0};
}

class RimLineDirection : public CriticalDirection {
 public:
  RimLineDirection(Profile profile, CurveRoot t) : profile_(std::move(profile)), t_(std::move(t)) {}

  void enclose(const Difference&, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = direction();
    if (at_vertex(profile_.inward, n) == Certainty::no) return;
    out.push_back({balls.gap(n), n});
  }

  // q·n − radius |u × n| − flat |n|, times norm.
  ZeroGap zero_gap(const Difference&) override {
    const Polynomial a = profile_.along(profile_.q);
    const Polynomial u_n = profile_.along(profile_.disc.axis);
    const Polynomial n_n = profile_.length_squared();
    const Polynomial b = Integer(profile_.radius * profile_.radius) * (n_n - u_n * u_n);
    const Polynomial c = Integer(profile_.flat * profile_.flat) * n_n;
    if (!is_zero_here(a, b, c)) return ZeroGap::unknown;
    return at_vertex(profile_.inward, direction()) == Certainty::yes ? ZeroGap::zero
                                                                     : ZeroGap::at_most_zero;
  }

  bool is_across(const IntegerVector& v) override {
    const Integer constant = dot(v, profile_.line.e), slope = dot(v, profile_.line.f);
    if (slope == 0) return constant == 0;
    return t_.is(profile_, -constant, slope);
  }

 private:
  /// Is a − √b − √c zero at this root?
  bool is_zero_here(const Polynomial& a, const Polynomial& b, const Polynomial& c) {
    if (t_.is_root_of(profile_, b)) {
      // The direction is the disc's axis.
      return is_zero(c) ? t_.is_root_of(profile_, a) : is_zero_here(a, c, {0});
    }
    if (!t_.is_root_of(profile_, root_sum_norm(a, b, c))) return false;
    const Ball t = t_.enclose(profile_);
    return has_no_other_zero(value_at(a, t), value_at(b, t), value_at(c, t));
  }

  BallVector direction() {
    return to_balls(profile_.line.e) + t_.enclose(profile_) * to_balls(profile_.line.f);
  }

  Profile profile_;
  CurveRoot t_;
};

}  // namespace

void append_disc_axis(const Difference& difference, const CriticalSite& site,
                      CriticalDirections& out) {
  out.push_back(rational_direction(difference.discs[site.first].frame.axis));
}

void append_face(const Difference& difference, const CriticalSite& site, CriticalDirections& out) {
  out.push_back(single_direction(face_normal(*difference.hull, static_cast<int>(site.first))));
}

void append_crossing(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out) {
  const IntegerVector other = difference.hull
                                  ? edge_vector(*difference.hull, static_cast<int>(site.second))
                                  : difference.segments[site.second].frame.axis;
  out.push_back(rational_direction(cross(difference.segments[site.first].frame.axis, other)));
}

void append_radial(const Difference& difference, const CriticalSite& site,
                   CriticalDirections& out) {
  const auto& segment = difference.segments[site.first];
  const IntegerVector n = off_axis(reduced_point(difference, site), segment.frame);
  if (!is_zero(n)) {
    out.push_back(rational_direction(n));
    return;
  }
  // The vertex lies on the axis: all radial directions of its sector have the same gap. The sector
  // may be a single direction, or empty.
  DirectionFamily family = sector(segment.frame.axis, inward(difference, site));
  if (family.kind == NormalFamily::Kind::circle) {
    out.push_back(rational_direction(segment.frame.e, std::move(family)));
  } else if (!family.ends.empty()) {
    const IntegerVector end = family.ends.front();
    out.push_back(rational_direction(end, std::move(family)));
  }
}

void append_rim_vertex(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out) {
  const auto& disc = difference.discs.front();
  const Integer radius = disc.radius * difference.norm;
  const IntegerVector q = reduced_point(difference, site);
  IntegerVector across = off_axis(q, disc.frame);
  // across is norm² q⊥.
  const Integer reach = difference.norm * difference.norm * radius;
  const int beyond = cmp(dot(across, across), reach * reach);
  if (beyond == 0 && dot(q, disc.frame.axis) == 0) {
    // The vertex lies on the rim: all normals of that rim point have the gap −inflation.
    std::vector<IntegerVector> sides = inward(difference, site);
    sides.push_back(across);
    DirectionFamily arc = sector(cross(disc.frame.axis, across), sides);
    if (arc.ends.empty()) return;
    const IntegerVector end = arc.ends.front();
    out.push_back(rational_direction(end, std::move(arc)));
  }
  // Only a vertex outside the rim is a separate maximum.
  if (beyond <= 0) return;
  out.push_back(
      std::make_unique<RimVertexDirection>(q, inward(difference, site), radius, std::move(across)));
}

namespace {

/// The line's frame before it is turned by quarters.
Frame line_frame(const Difference& difference, const CriticalSite& site) {
  if (!difference.hull) {
    auto [frame, stretch] = turned_frame(difference.segments[site.first].frame, site.heading);
    return {stretch * frame.axis, std::move(frame.e), std::move(frame.f)};
  }
  // e crosses A's axis and the edge, so that A's disc is seen along f.
  const IntegerVector edge = edge_vector(*difference.hull, static_cast<int>(site.first));
  const IntegerVector e{-edge.y, edge.x, 0};
  return {edge, e, cross(edge, e)};
}

Profile profile_at(const Difference& difference, const CriticalSite& site) {
  const auto& disc = difference.discs[site.second];
  Integer flat = difference.inflation;
  for (const auto& other : difference.discs) {
    if (&other != &disc) flat += other.radius;
  }
  const Frame line = turned(line_frame(difference, site), site.turn);
  return {difference.norm,
          line,
          difference.hull.has_value(),
          inward(difference, site),
          reduced_point(difference, site),
          disc.frame,
          disc.radius,
          std::move(flat)};
}

}  // namespace

void append_rim_line(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out) {
  Profile profile = profile_at(difference, site);
  if (site.branch != 0) {
    const SlopeBracket bracket{site.lo, site.hi, site.branch, site.rising};
    out.push_back(std::make_unique<RimLineDirection>(std::move(profile), CurveRoot(bracket)));
    return;
  }
  const Polynomial quartic = profile.polynomial();
  if (is_zero(quartic)) {
    // The line lies in the disc's plane, and the end of the projected disc coincides with the
    // reduced point (or its mirror image does): the gap is constant over all directions of that
    // end's normal cone.
    const auto& [axis, e, f] = profile.line;
    std::vector<IntegerVector> sides = profile.inward;
    sides.push_back(Integer(Profile::squared(f) * dot(profile.q, e)) * e +
                    Integer(Profile::squared(e) * dot(profile.q, f)) * f);
    DirectionFamily arc = sector(axis, sides);
    if (!arc.ends.empty()) {
      const IntegerVector end = arc.ends.front();
      out.push_back(rational_direction(end, std::move(arc)));
    }
    return;
  }
  mpq_class lo(site.lo), hi(site.hi);
  if (const auto stretch = profile.stretch()) {
    lo = (Ball(lo) / *stretch).lower();
    hi = (Ball(hi) / *stretch).upper();
  }
  for (auto& root : real_roots(quartic, lo, hi)) {
    out.push_back(std::make_unique<RimLineDirection>(profile, std::move(root)));
  }
}

}  // namespace touchstone::oracle
