#include "oracle/patch/feature_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace touchstone::oracle {
namespace {

mpq_class square(const mpq_class& q) { return q * q; }
double root(const mpq_class& q) { return std::sqrt(q.get_d()); }
mpq_class clamped(const mpq_class& q, const mpq_class& limit) {
  return q > limit ? limit : q < -limit ? mpq_class(-limit) : q;
}

/// Exact sign of p − √q; q >= 0.
int sign_of_minus_root(const mpq_class& p, const mpq_class& q) {
  if (p < 0) return -1;
  return cmp(square(p), q);
}

ConvexSet on_axis(const mpq_class& lo, const mpq_class& hi) {
  const Vec2 from(lo.get_d(), 0), to(hi.get_d(), 0);
  return lo < hi ? ConvexSet::segment(from, to) : ConvexSet::point(from);
}

ConvexSet whole_disc(const Vec2& centre, double radius) {
  return ConvexSet::region({BoundaryPiece::arc(centre, radius, 0, 2 * pi)});
}

/// The part of an edge within a disc, of positive length. The edge is |x| <= half_edge of the x
/// axis.
struct Chord {
  bool from_corner, to_corner;  ///< it ends at the edge's end, not at the circle
  double from, to;
};

/// The circle intersects the edge's line at along ± √half_chord2.
std::optional<Chord> chord(const mpq_class& along, const mpq_class& half_chord2,
                           const mpq_class& half_edge) {
  if (half_chord2 <= 0) return std::nullopt;
  const mpq_class before = along + half_edge, after = half_edge - along;
  if (sign_of_minus_root(-before, half_chord2) >= 0) return std::nullopt;
  if (sign_of_minus_root(-after, half_chord2) >= 0) return std::nullopt;
  const bool from_corner = sign_of_minus_root(before, half_chord2) <= 0;
  const bool to_corner = sign_of_minus_root(after, half_chord2) <= 0;
  const double half_chord = root(half_chord2), middle = along.get_d(), end = half_edge.get_d();
  return Chord{from_corner, to_corner, from_corner ? -end : middle - half_chord,
               to_corner ? end : middle + half_chord};
}

/// A chord of a rectangle's edge, whose coordinates have the origin in the middle of the edge, x
/// along it (counterclockwise), and the rectangle's outside at y < 0.
struct EdgeChord : Chord {
  int edge;
  double start_angle,
      end_angle;  ///< polar angles of the ends about the disc's centre, in the rectangle's frame
};

/// `along` and `inside` are the disc's centre in the edge's coordinates.
std::optional<EdgeChord> edge_chord(int edge, const mpq_class& along, const mpq_class& inside,
                                    const mpq_class& radius, const mpq_class& half_edge) {
  const mpq_class half_chord2 = square(radius) - square(inside);
  const auto c = chord(along, half_chord2, half_edge);
  if (!c) return std::nullopt;
  const double half_chord = root(half_chord2), y = -inside.get_d();
  const double back = c->from_corner ? mpq_class(along + half_edge).get_d() : half_chord;
  const double forth = c->to_corner ? mpq_class(half_edge - along).get_d() : half_chord;
  // Edge 0 runs along +x below the rectangle; each next edge is turned by 90°.
  return EdgeChord{*c, edge, std::atan2(y, -back) + edge * pi / 2,
                   std::atan2(y, forth) + edge * pi / 2};
}

}  // namespace

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

ConvexSet overlap_of_disc_and_rectangle(const mpq_class& x, const mpq_class& y, const mpq_class& r,
                                        const mpq_class& a, const mpq_class& b) {
  std::vector<EdgeChord> chords;
  const auto add = [&](const std::optional<EdgeChord>& c) {
    if (c) chords.push_back(*c);
  };
  add(edge_chord(0, x, y + b, r, a));
  add(edge_chord(1, y, a - x, r, b));
  add(edge_chord(2, -x, b - y, r, a));
  add(edge_chord(3, -y, x + a, r, b));
  const Vec2 centre(x.get_d(), y.get_d());
  const double radius = r.get_d(), width = a.get_d(), height = b.get_d();
  if (chords.empty()) {
    if (abs(x) + r <= a && abs(y) + r <= b) return whole_disc(centre, radius);
    return ConvexSet::point({clamped(x, a).get_d(), clamped(y, b).get_d()});
  }
  const auto in_frame = [&](int edge, double along) -> Vec2 {
    switch (edge) {
      case 0:
        return {along, -height};
      case 1:
        return {width, along};
      case 2:
        return {-along, height};
      default:
        return {-width, -along};
    }
  };
  std::vector<BoundaryPiece> sides;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const EdgeChord& c = chords[i];
    const EdgeChord& next = chords[(i + 1) % chords.size()];
    sides.push_back(BoundaryPiece::line(in_frame(c.edge, c.from), in_frame(c.edge, c.to)));
    const bool share_a_corner = c.to_corner && next.from_corner && next.edge == (c.edge + 1) % 4;
    if (share_a_corner) continue;
    double sweep = next.start_angle - c.end_angle;
    sweep -= 2 * pi * std::floor(sweep / (2 * pi));
    // A full turn is possible with a single edge only; between two edges it is a rounded zero.
    constexpr double rounding = 1e-9;
    if (chords.size() > 1 && sweep > 2 * pi - rounding) sweep = 0;
    BoundaryPiece arc = BoundaryPiece::arc(centre, radius, c.end_angle, sweep);
    arc.from = in_frame(c.edge, c.to);
    arc.to = in_frame(next.edge, next.from);
    sides.push_back(arc);
  }
  return ConvexSet::region(std::move(sides));
}

ConvexSet overlap_of_disc_and_segment(const mpq_class& along, const mpq_class& off2,
                                      const mpq_class& r, const mpq_class& half_length) {
  const auto c = chord(along, square(r) - off2, half_length);
  if (!c) return ConvexSet::point({clamped(along, half_length).get_d(), 0});
  return ConvexSet::segment({c->from, 0}, {c->to, 0});
}

ConvexSet overlap_of_segment_and_rectangle(const mpq_class& x, const mpq_class& y,
                                           const mpq_class& dx, const mpq_class& dy,
                                           const mpq_class& half_length, const mpq_class& a,
                                           const mpq_class& b) {
  // Liang and Barsky 1984.
  mpq_class lo = -half_length, hi = half_length;
  bool misses = false;
  const auto clip = [&](const mpq_class& at, const mpq_class& d, const mpq_class& limit) {
    if (d == 0) {
      misses = misses || abs(at) > limit;
      return;
    }
    mpq_class first = (-limit - at) / d, last = (limit - at) / d;
    if (first > last) std::swap(first, last);
    lo = std::max(lo, first);
    hi = std::min(hi, last);
  };
  clip(x, dx, a);
  clip(y, dy, b);
  const auto at = [&](const mpq_class& t) {
    return Vec2(clamped(x + t * dx, a).get_d(), clamped(y + t * dy, b).get_d());
  };
  if (misses || lo > hi) return ConvexSet::point(at((lo + hi) / 2));
  return lo < hi ? ConvexSet::segment(at(lo), at(hi)) : ConvexSet::point(at(lo));
}

ConvexSet overlap_of_segments(const mpq_class& half_length, const mpq_class& along,
                              const mpq_class& other_half_length) {
  const mpq_class lo = std::max<mpq_class>(-half_length, along - other_half_length);
  const mpq_class hi = std::min<mpq_class>(half_length, along + other_half_length);
  if (lo > hi) return on_axis((lo + hi) / 2, (lo + hi) / 2);
  return on_axis(lo, hi);
}

}  // namespace touchstone::oracle
