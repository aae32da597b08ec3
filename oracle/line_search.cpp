#include "oracle/line_search.hpp"

namespace touchstone::oracle {

LineSearch::LineSearch(const IntervalDifference& difference, unsigned segment)
    : inflation_(difference.inflation) {
  const auto& line = difference.segments[segment].frame;
  const auto planar = [&](const IntervalVector& v) {
    return Planar{dot(v, line.e), dot(v, line.f)};
  };
  d_ = planar(difference.d);
  for (const auto& s : difference.segments) {
    if (&s.frame != &line) segments_.push_back({planar(s.frame.axis), s.half_length});
  }
  for (const auto& disc : difference.discs) {
    discs_.push_back({planar(disc.frame.axis), dot(disc.frame.axis, line.axis), disc.radius});
  }
}

LineSearch::At LineSearch::at(const Piece& piece, const Interval& t) {
  const Interval length = sqrt(Interval(1) + square(t));
  switch (piece.turn) {
    case 0:
      return {1, t, length};
    case 1:
      return {-t, 1, length};
    case 2:
      return {-1, -t, length};
    default:
      return {t, -1, length};
  }
}

/// |axis × n|, of which a near-parallel disc loses nothing to cancellation.
Interval LineSearch::sine(const Disc& disc, const At& n) const {
  return sqrt(square(across(disc.axis, n)) + square(disc.along * n.length));
}

Interval LineSearch::gap(const At& n) const {
  Interval value = along(d_, n);
  for (const auto& s : segments_) value -= s.half_length * abs(along(s.axis, n));
  for (const auto& disc : discs_) value -= disc.radius * sine(disc, n);
  return value / n.length - inflation_;
}

unsigned long LineSearch::open_vertices(const Piece& piece, Bar& bar) const {
  const At middle = at(piece, Interval((piece.lo + piece.hi) / 2));
  const Interval at_middle = gap(middle);
  bar.raise(at_middle);

  const At n = at(piece, Interval(piece.lo, piece.hi));
  // Slope along the circle, times n.length; that of the segments follows from their signs.
  Interval smooth = across(d_, n);
  for (const auto& disc : discs_) {
    const Interval u = along(disc.axis, n), du = across(disc.axis, n), s = sine(disc, n);
    // |du| <= s
    const Interval bounded = abs(u) * Interval(-1, 1);
    smooth += disc.radius * (s.inf() > 0 ? u * du / s : bounded);
  }
  Interval any_slope = smooth;
  unsigned long open = 1;  // over the vertices of the segments seen so far
  std::array<Interval, 8> slopes{smooth};
  std::size_t count = 1;
  for (const auto& s : segments_) {
    const Interval side = along(s.axis, n);
    const Interval change = s.half_length * across(s.axis, n);
    any_slope += (side.inf() > 0   ? -change
                  : side.sup() < 0 ? change
                                   : abs(change) * Interval(-1, 1));
    const unsigned long negative = side.inf() > 0 ? 0 : open;
    const unsigned long positive = side.sup() < 0 ? 0 : open;
    for (std::size_t v = 0; v < count; ++v) {
      slopes[count + v] = slopes[v] - change;
      slopes[v] += change;
    }
    open = negative | positive << count;
    count *= 2;
  }

  // dφ <= dt, and g is as steep as the steepest of its pieces.
  const Interval half = Interval(piece.hi) - Interval(piece.lo);
  const Interval ahead = at_middle + abs(any_slope / n.length) * half * Interval(0.5);
  if (bar.is_above(ahead) || bar.is_above(gap(n))) return 0;

  for (std::size_t v = 0; v < count; ++v) {
    const Interval& slope = slopes[v];
    if (slope.inf() > 0 || slope.sup() < 0) open &= ~(1UL << v);
  }
  return open;
}

}  // namespace touchstone::oracle
