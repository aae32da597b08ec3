#include "oracle/patch/feature_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace touchstone::oracle {
namespace {

using FeatureKind = SupportFeature::Kind;

mpq_class square(const mpq_class& q) { return q * q; }
mpq_class square(const RationalVector& v) { return dot(v, v); }
double root(const mpq_class& q) { return std::sqrt(q.get_d()); }
mpq_class clamped(const mpq_class& q) { return q > 1 ? mpq_class(1) : q < -1 ? mpq_class(-1) : q; }

/// Where lengths lie 1e300 apart, corners of a face may be on one line and what is left of a
/// direction zero; then it counts as a point.
mpq_class quotient(const mpq_class& a, const mpq_class& b) {
  return b == 0 ? mpq_class(0) : mpq_class(a / b);
}

/// Coordinate of `v` along a direction of any length. (Products with that may overflow as doubles.)
double coordinate(const RationalVector& v, const RationalVector& direction) {
  const mpq_class product = dot(v, direction);
  return sgn(product) * root(quotient(square(product), square(direction)));
}

/// Exact sign of p − √q; q >= 0.
int sign_of_minus_root(const mpq_class& p, const mpq_class& q) {
  if (p < 0) return -1;
  return cmp(square(p), q);
}

Placement at_point(const Vec3& p, const Vec3& n) {
  return {ConvexSet::point(Vec2::Zero()), p, n.unitOrthogonal()};
}

/// The part of a segment from `lo` to `hi`, in halves of it; the point between them if lo > hi.
Placement along(const SupportFeature& segment, const mpq_class& lo, const mpq_class& hi) {
  const double half = root(square(segment.u));
  const auto at = [&](const mpq_class& t) { return Vec2(t.get_d() * half, 0); };
  return {
      lo < hi ? ConvexSet::segment(at(lo), at(hi)) : ConvexSet::point(at(clamped((lo + hi) / 2))),
      rounded(segment.centre), rounded(segment.u)};
}

ConvexSet whole_disc(const Vec2& centre, double radius) {
  return ConvexSet::region({BoundaryPiece::arc(centre, radius, 0, 2 * pi)});
}

/// Two discs with one axis, in the plane through the first one's middle; x towards the second's.
ConvexSet overlap_of_discs(const mpq_class& r, const mpq_class& s, const mpq_class& distance2) {
  const double radius = r.get_d(), other = s.get_d(), distance = root(distance2);
  if (distance2 <= square(r - s)) {
    return r <= s ? whole_disc(Vec2::Zero(), radius) : whole_disc({distance, 0}, other);
  }
  if (distance2 == square(r + s)) return ConvexSet::point({radius, 0});
  if (distance2 > square(r + s)) return ConvexSet::point({distance - other, 0});
  // The circles intersect at (x, ±y). Twice the distance times x, and times distance − x:
  const mpq_class from_first = distance2 + square(r) - square(s);
  const mpq_class from_other = distance2 + square(s) - square(r);
  const double y = root(4 * distance2 * square(r) - square(from_first));
  const double angle = std::atan2(y, from_first.get_d());
  const double other_angle = std::atan2(y, from_other.get_d());
  BoundaryPiece first = BoundaryPiece::arc(Vec2::Zero(), radius, -angle, 2 * angle);
  BoundaryPiece second =
      BoundaryPiece::arc({distance, 0}, other, pi - other_angle, 2 * other_angle);
  // Both arcs get the same ends, so that the boundary of a thin lens does not intersect itself.
  first.to = second.from = Vec2(from_first.get_d(), y) / (2 * distance);
  first.from = second.to = Vec2(from_first.get_d(), -y) / (2 * distance);
  return ConvexSet::region({first, second});
}

Placement discs(const SupportFeature& first, const SupportFeature& second, const Vec3& n) {
  const RationalVector w = second.centre - first.centre;
  const RationalVector across = w - quotient(dot(w, first.u), square(first.u)) * first.u;
  const Vec3 direction = rounded(across);
  return {overlap_of_discs(first.radius, second.radius, square(across)), rounded(first.centre),
          direction.isZero(0) ? n.unitOrthogonal() : direction};
}

/// A disc seen from a segment in its plane.
struct DiscBeside {
  mpq_class along;    ///< of the disc's middle from the segment's, in halves of the segment
  int side;           ///< +1: the disc's middle is to the left of the segment, about `axis`
  mpq_class off2;     ///< its squared distance from the segment's line
  mpq_class chord2;   ///< squared half of the chord on that line; negative if there is none
  mpq_class length2;  ///< squared half of the segment

  DiscBeside(const SupportFeature& disc, const RationalVector& middle, const RationalVector& half,
             const RationalVector& axis)
      : length2(square(half)) {
    const RationalVector w = disc.centre - middle, left = cross(axis, half);
    const mpq_class beside = dot(w, left), left2 = square(left);
    along = quotient(dot(w, half), length2);
    side = sgn(beside);
    off2 = quotient(square(beside), left2);
    chord2 = left2 == 0 ? mpq_class(-1) : mpq_class(square(disc.radius) - off2);
  }

  /// Do circle and segment share more than a point?
  bool has_chord() const {
    return chord2 > 0 && sign_of_minus_root(-along - 1, chord2 / length2) < 0 &&
           sign_of_minus_root(along - 1, chord2 / length2) < 0;
  }
  /// Is the segment's first (second) end within the circle, so that the chord ends there?
  bool holds_from() const { return sign_of_minus_root(along + 1, chord2 / length2) <= 0; }
  bool holds_to() const { return sign_of_minus_root(1 - along, chord2 / length2) <= 0; }
};

Placement segment_and_disc(const SupportFeature& segment, const SupportFeature& disc) {
  const DiscBeside beside(disc, segment.centre, segment.u, disc.u);
  if (!beside.has_chord()) return along(segment, beside.along, beside.along);
  const double half = root(beside.length2), chord = root(beside.chord2);
  const double middle = beside.along.get_d() * half;
  return {ConvexSet::segment({beside.holds_from() ? -half : middle - chord, 0},
                             {beside.holds_to() ? half : middle + chord, 0}),
          rounded(segment.centre), rounded(segment.u)};
}

RationalVector normal_of(const std::vector<RationalVector>& corners) {
  return cross(corners[1] - corners[0], corners[2] - corners[1]);
}

/// The part of a polygon's edge within a disc, in the plane about the disc's middle.
struct EdgeChord {
  std::size_t edge;
  bool from_corner, to_corner;  ///< it ends at the edge's end, not at the circle
  Vec2 from, to;
  double rest;  ///< angle of the circle inside the polygon if no other edge cuts it
};

/// The region that chords of a polygon bound together with arcs of the circle between them.
ConvexSet bounded_by(const std::vector<EdgeChord>& chords, double radius, std::size_t edges) {
  std::vector<BoundaryPiece> sides;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const EdgeChord &c = chords[i], &next = chords[(i + 1) % chords.size()];
    sides.push_back(BoundaryPiece::line(c.from, c.to));
    if (c.to_corner && next.from_corner && next.edge == (c.edge + 1) % edges) continue;
    const double start = std::atan2(c.to.y(), c.to.x());
    double sweep = std::atan2(next.from.y(), next.from.x()) - start;
    sweep -= 2 * pi * std::floor(sweep / (2 * pi));
    // A full turn is possible with a single edge only; between two edges it is a rounded zero.
    constexpr double rounding = 1e-9;
    if (chords.size() == 1)
      sweep = c.rest;
    else if (sweep > 2 * pi - rounding)
      sweep = 0;
    sides.push_back({c.to, next.from, Vec2::Zero(), radius, start, sweep});
  }
  return ConvexSet::region(std::move(sides));
}

Placement disc_and_polygon(const SupportFeature& disc, const SupportFeature& face) {
  const std::vector<RationalVector>& corners = face.corners;
  const RationalVector normal = normal_of(corners);
  const RationalVector e1 = corners[1] - corners[0], e2 = cross(normal, e1);
  const auto seen = [&](const RationalVector& v) {
    return Vec2(coordinate(v, e1), coordinate(v, e2));
  };
  std::vector<EdgeChord> chords;
  bool is_within = true;
  Vec2 nearest = Vec2::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const RationalVector &p = corners[i], &q = corners[(i + 1) % corners.size()];
    const RationalVector middle = mpq_class(1, 2) * (p + q), half = mpq_class(1, 2) * (q - p);
    const DiscBeside beside(disc, middle, half, normal);
    is_within = is_within && beside.side > 0 && beside.chord2 <= 0;
    if (!beside.has_chord()) {
      const Vec2 point = seen(middle + clamped(beside.along) * half - disc.centre);
      if (point.norm() < nearest.norm()) nearest = point;
      continue;
    }
    const Vec2 direction = seen(half).stableNormalized(), left(-direction.y(), direction.x());
    const double off = beside.side * root(beside.off2), chord = root(beside.chord2);
    const bool from = beside.holds_from(), to = beside.holds_to();
    chords.push_back({i, from, to, from ? seen(p - disc.centre) : -off * left - chord * direction,
                      to ? seen(q - disc.centre) : -off * left + chord * direction,
                      2 * (pi - std::atan2(chord, off))});
  }
  const double radius = disc.radius.get_d();
  return {is_within        ? whole_disc(Vec2::Zero(), radius)
          : chords.empty() ? ConvexSet::point(nearest)
                           : bounded_by(chords, radius, corners.size()),
          rounded(disc.centre), rounded(e1)};
}

/// Cyrus and Beck 1978.
Placement segment_and_polygon(const SupportFeature& segment, const SupportFeature& face) {
  const RationalVector normal = normal_of(face.corners);
  mpq_class lo = -1, hi = 1;
  bool is_beside = false;
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const RationalVector& p = face.corners[i];
    const RationalVector inward = cross(normal, face.corners[(i + 1) % face.corners.size()] - p);
    const mpq_class at = dot(segment.centre - p, inward), slope = dot(segment.u, inward);
    if (slope > 0) lo = std::max<mpq_class>(lo, -at / slope);
    if (slope < 0) hi = std::min<mpq_class>(hi, -at / slope);
    is_beside = is_beside || (slope == 0 && at < 0);
  }
  return is_beside ? along(segment, (lo + hi) / 2, (lo + hi) / 2) : along(segment, lo, hi);
}

/// The point where two segments that are not parallel cross, seen along their common perpendicular;
/// none if they miss each other.
std::optional<Placement> crossing(const SupportFeature& first, const SupportFeature& second,
                                  const RationalVector& perpendicular, const Vec3& n) {
  const RationalVector w = second.centre - first.centre;
  const mpq_class s = quotient(dot(cross(w, second.u), perpendicular), square(perpendicular));
  const mpq_class t = quotient(dot(cross(w, first.u), perpendicular), square(perpendicular));
  if (abs(s) > 1 || abs(t) > 1) return std::nullopt;
  return at_point(rounded(first.centre + s * first.u), n);
}

std::optional<Placement> segments(const SupportFeature& first, const SupportFeature& second,
                                  const Vec3& n) {
  const RationalVector perpendicular = cross(first.u, second.u);
  if (!is_zero(perpendicular)) return crossing(first, second, perpendicular, n);
  const mpq_class middle = quotient(dot(second.centre - first.centre, first.u), square(first.u));
  const mpq_class half = quotient(abs(dot(second.u, first.u)), square(first.u));
  return along(first, std::max<mpq_class>(-1, middle - half),
               std::min<mpq_class>(1, middle + half));
}

std::optional<Placement> alone(const SupportFeature& f, const Vec3& n) {
  if (f.kind == FeatureKind::disc) return discs(f, f, n);
  return segments(f, f, n);
}

}  // namespace

std::optional<Placement> overlap(const SupportFeature& a, const SupportFeature& b, const Vec3& n) {
  using enum SupportFeature::Kind;
  if (a.kind == point && b.kind == point) return at_point((a.point + b.point) / 2, n);
  if (a.kind == point) return at_point(a.point, n);
  if (b.kind == point) return at_point(b.point, n);
  if (b.kind == plane) return alone(a, n);
  if (a.kind == segment) {
    if (b.kind == segment) return segments(a, b, n);
    return b.kind == disc ? segment_and_disc(a, b) : segment_and_polygon(a, b);
  }
  if (b.kind == segment) return segment_and_disc(b, a);
  return b.kind == disc ? discs(a, b, n) : disc_and_polygon(a, b);
}

}  // namespace touchstone::oracle
