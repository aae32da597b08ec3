#include "oracle/curve_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "oracle/critical_direction.hpp"

namespace touchstone::oracle {

namespace {

/// An integer as mantissa times a power of two.
struct ScaledInterval {
  Interval mantissa;  // its magnitude within [1/2, 1], or zero
  long exponent;
};

ScaledInterval scaled(const Integer& value) {
  ScaledInterval result{0, 0};
  const double towards_zero = mpz_get_d_2exp(&result.exponent, value.get_mpz_t());
  if (towards_zero == 0) return result;
  const double away = std::nextafter(towards_zero, towards_zero > 0 ? 1 : -1);
  result.mantissa = mpz_sizeinbase(value.get_mpz_t(), 2) <= 53 ? Interval(towards_zero)
                    : towards_zero > 0                         ? Interval(towards_zero, away)
                                                               : Interval(away, towards_zero);
  return result;
}

Interval ratio(const Integer& numerator, const ScaledInterval& denominator) {
  const ScaledInterval top = scaled(numerator);
  const Interval mantissas = top.mantissa / denominator.mantissa;
  const long exponent = top.exponent - denominator.exponent;
  // Within this limit a power of two neither rounds nor overflows.
  constexpr long limit = 900;
  if (exponent < -limit) {
    const double tiny = std::ldexp(1, -static_cast<int>(limit));
    return {-tiny, tiny};
  }
  if (exponent > limit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {-infinity, infinity};
  }
  return mantissas * Interval(std::ldexp(1, static_cast<int>(exponent)));
}

IntervalVector ratio(const IntegerVector& v, const ScaledInterval& denominator) {
  return {ratio(v.x, denominator), ratio(v.y, denominator), ratio(v.z, denominator)};
}

IntervalDifference::IntervalFrame unit(const Frame& frame, const ScaledInterval& norm) {
  return {ratio(frame.axis, norm), ratio(frame.e, norm), ratio(frame.f, norm)};
}

Integer largest_coordinate(const IntegerVector& v) {
  return std::max({Integer(abs(v.x)), Integer(abs(v.y)), Integer(abs(v.z))});
}

}  // namespace

IntervalVector scaled_direction(const IntegerVector& v) {
  return ratio(v, scaled(largest_coordinate(v)));
}

IntervalDifference::IntervalDifference(const Difference& difference)
    : scale(sum_of_sizes(difference)) {
  const ScaledInterval norm = scaled(difference.norm);
  const ScaledInterval length = scaled(scale), length_norm = scaled(scale * difference.norm);

  metre = ratio(difference.per_metre, length);
  d = ratio(difference.d, length_norm);
  for (const auto& s : difference.segments) {
    segments.push_back({unit(s.frame, norm), ratio(s.half_length, length)});
  }
  for (const auto& disc : difference.discs) {
    discs.push_back({unit(disc.frame, norm), ratio(disc.radius, length)});
  }
  inflation = ratio(difference.inflation, length);
  if (!difference.hull) return;
  for (const IntegerVector& v : difference.hull->vertices) {
    vertices.push_back(ratio(v, length_norm));
  }
}

OppositeGaps IntervalDifference::gaps(const IntervalVector& n) const {
  const Interval length = norm(n);
  const Interval centre_distance = dot(d, n) / length;
  const Interval half_width = add_half_width(Interval(0), segments, discs, n) / length + inflation;
  return {centre_distance - half_width, -centre_distance - half_width};
}

OppositeGaps IntervalDifference::gaps_of_hull(const IntervalVector& n) const {
  Interval highest = dot(vertices.front(), n), lowest = highest;
  for (const IntervalVector& v : vertices) {
    const Interval height = dot(v, n);
    highest = max(highest, height);
    lowest = min(lowest, height);
  }
  const auto [forth, back] = gaps(n);
  const Interval length = norm(n);
  return {forth - highest / length, back + lowest / length};
}

Interval IntervalDifference::gap_of_vertex(const IntervalVector& vertex,
                                           const IntervalVector& n) const {
  return (dot(d - vertex, n) - add_half_width(Interval(0), segments, discs, n)) / norm(n) -
         inflation;
}

namespace {

/// tan(φ/2) of the angle φ, within an eighth of a turn, by which a frame has to be turned so that
/// the planar vector (e, f) lies along one of its axes, to within rounding.
double heading_of(double e, double f) {
  if (std::abs(f) > std::abs(e)) {
    std::swap(e, f);
    f = -f;
  }
  const double tangent = f / (e + std::copysign(std::sqrt(e * e + f * f), e));
  return std::ldexp(std::nearbyint(std::ldexp(tangent, heading_bits)), -heading_bits);
}

}  // namespace

LineSearch::LineSearch(const IntervalDifference& difference, const Difference& exact,
                       unsigned segment, std::optional<unsigned> tilted_disc)
    : line_(segment), inflation_(difference.inflation), tilted_disc_(tilted_disc) {
  auto line = difference.segments[segment].frame;
  const auto planar = [&](const IntervalVector& v) {
    return Planar{dot(v, line.e), dot(v, line.f)};
  };
  bool is_nearly_perpendicular = false;
  if (tilted_disc) {
    // The gap bends sharply where the direction passes the axis of a disc that is nearly
    // perpendicular to the line. There t has to be near zero, where doubles are dense, and the
    // disc's axis is needed to a small relative error.
    constexpr double nearly_perpendicular = 0x1p-6;
    const IntervalVector& u = difference.discs[*tilted_disc].frame.axis;
    is_nearly_perpendicular = abs(dot(u, line.axis)).sup() < nearly_perpendicular;
    if (is_nearly_perpendicular) {
      const Planar before = planar(u);
      heading_ = heading_of(before.e.sup(), before.f.sup());
      const Interval scale = Interval(1) / (Interval(1) + square(Interval(heading_)));
      const Interval cosine = (Interval(1) - square(Interval(heading_))) * scale;
      const Interval sine = Interval(2 * heading_) * scale;
      const IntervalVector e = cosine * line.e + sine * line.f;
      line.f = cosine * line.f - sine * line.e;
      line.e = e;
    }
  }
  d_ = planar(difference.d);
  for (unsigned i = 0; i < difference.segments.size(); ++i) {
    const auto& s = difference.segments[i];
    if (i != segment) segments_.push_back({planar(s.frame.axis), s.half_length});
  }
  for (const auto& disc : difference.discs) {
    discs_.push_back({planar(disc.frame.axis), dot(disc.frame.axis, line.axis), disc.radius});
  }
  if (is_nearly_perpendicular) {
    const Integer& norm = exact.norm;
    const TurnedFrame turned = turned_frame(exact.segments[segment].frame, heading_);
    const IntegerVector& u = exact.discs[*tilted_disc].frame.axis;
    const Integer along = dot(u, turned.frame.axis);
    const ScaledInterval length = scaled(norm * norm * turned.stretch);
    Disc& disc = discs_[*tilted_disc];
    disc.axis = {ratio(dot(u, turned.frame.e), length), ratio(dot(u, turned.frame.f), length)};
    disc.along = ratio(along, scaled(norm * norm));
    is_flat_ = along == 0;
  }
}

LineSearch::LineSearch(const IntervalDifference& difference, const Difference& exact, unsigned edge,
                       const IntegerVector& direction, const IntegerVector& q,
                       const IntervalVector& from, const IntervalVector& to)
    : line_(edge), inflation_(difference.inflation), tilted_disc_(0), is_flat_(direction.z == 0) {
  // e crosses A's axis z and the edge w, f = w × e: the axis is seen along f. What q has along them
  // is exact before it is rounded: near the edge it may be small against the bodies.
  const IntegerVector e_exact{-direction.y, direction.x, 0};
  const Integer longest = largest_coordinate(direction), across = largest_coordinate(e_exact);
  const IntervalVector w = ratio(direction, scaled(longest)), e = ratio(e_exact, scaled(across));
  const Interval e_length = norm(e), w_length = norm(w), cosine = w.z / w_length;
  const Interval sine = e_length * ratio(across, scaled(longest)) / w_length;
  const IntervalVector e_unit = Interval(1) / e_length * e;
  const IntervalVector f_unit{-cosine * e_unit.y, cosine * e_unit.x, sine};
  const auto planar = [&](const IntervalVector& v) {
    return Planar{dot(v, e_unit), dot(v, f_unit)};
  };
  const Integer unit = difference.scale * exact.norm * across;
  d_ = {ratio(dot(q, e_exact), scaled(unit)) / e_length,
        ratio(dot(q, cross(direction, e_exact)), scaled(unit * longest)) / (e_length * w_length)};
  segments_.push_back({{0, sine}, difference.segments.front().half_length});
  discs_.push_back({{0, sine}, cosine, difference.discs.front().radius});
  arc_ = Arc{planar(from), planar(to)};
}

// With n = (1, t), turned: t must be left of `from` and right of `to`.
Piece LineSearch::in_arc(unsigned turn) const {
  Piece piece{0, turn, -1, 1};
  const auto cut = [&](const Interval& x, const Interval& y) {  // x t >= y
    if (x.inf() > 0) {
      piece.lo = std::max(piece.lo, (y / x).inf());
    } else if (x.sup() < 0) {
      piece.hi = std::min(piece.hi, (y / x).sup());
    } else if (y.inf() > abs(x).sup()) {
      piece.hi = -2;
    }
  };
  const unsigned back = (4 - turn) % 4;
  const auto [from_x, from_y] = turned(arc_->from.e, arc_->from.f, back);
  const auto [to_x, to_y] = turned(arc_->to.e, arc_->to.f, back);
  cut(from_x, from_y);
  cut(-to_x, -to_y);
  if (piece.lo > piece.hi) return piece;
  // So that an arc between faces that are nearly one is wide enough to have roots isolated in it.
  constexpr double margin = 0x1p-40;
  return {0, turn, piece.lo - margin, piece.hi + margin};
}

bool LineSearch::is_in_arc(const Direction& n) const {
  const auto is_left = [](const Interval& x, const Interval& y, const Planar& of) {
    return (of.e * y - of.f * x).inf() >= 0;
  };
  return !arc_ || (is_left(n.x, n.y, arc_->from) && is_left(-n.x, -n.y, arc_->to));
}

LineSearch::Direction LineSearch::direction(const Piece& piece, const Interval& t) {
  const Interval length = square_root<Interval>(Interval(1) + square(t));
  const auto [x, y] = turned<Interval>(1, t, piece.turn);
  return {x, y, length};
}

OppositeGaps LineSearch::gaps(const Direction& n) const {
  const Interval centre_distance = d_.along(n) / n.length;
  const Interval half_width =
      add_half_width(Interval(0), segments_, discs_, n) / n.length + inflation_;
  return {centre_distance - half_width, -centre_distance - half_width};
}

LineSearch::Open LineSearch::open_vertices(const Piece& piece, const Open& asked,
                                           GapThreshold& threshold) const {
  const Direction n = direction(piece, Interval(piece.lo, piece.hi));
  // The slope of the gap along the circle, times n.length, is that of the half width with or
  // against that of the centres' distance. The segments' part depends on their signs.
  const Interval centres = d_.across(n);
  Interval smooth = 0;
  for (const auto& disc : discs_) {
    const Interval u = disc.axis.along(n), du = disc.axis.across(n), s = disc.projection(n);
    // |du| <= s
    const Interval bounded = abs(u) * Interval(-1, 1);
    smooth += disc.radius * (s.inf() > 0 ? u * du / s : bounded);
  }
  Interval any_slope = smooth;
  unsigned long possible = 1;  // one bit for each vertex of the segments handled so far
  std::array<Interval, 8> slopes{smooth};
  unsigned count = 1;
  for (const auto& s : segments_) {
    const Interval side = s.axis.along(n);
    const Interval change = s.half_length * s.axis.across(n);
    any_slope += (side.inf() > 0   ? -change
                  : side.sup() < 0 ? change
                                   : abs(change) * Interval(-1, 1));
    const unsigned long negative = side.inf() > 0 ? 0 : possible;
    const unsigned long positive = side.sup() < 0 ? 0 : possible;
    for (unsigned v = 0; v < count; ++v) {
      slopes[count + v] = slopes[v] - change;
      slopes[v] += change;
    }
    possible = negative | positive << count;
    count *= 2;
  }

  const auto may_be_zero = [](const Interval& x) { return !(x.inf() > 0 || x.sup() < 0); };
  Open open{0, 0};
  for (unsigned v = 0; v < count; ++v) {
    if (!(possible >> v & 1UL)) continue;
    if (asked.forth != 0 && may_be_zero(slopes[v] + centres)) open.forth |= 1UL << v;
    // The opposite direction is on the other side of every segment.
    if (asked.back != 0 && may_be_zero(slopes[v] - centres)) open.back |= 1UL << (count - 1 - v);
  }
  if (open.forth == 0 && open.back == 0) return open;

  const Direction halfway = direction(piece, Interval((piece.lo + piece.hi) / 2));
  const OppositeGaps at_middle = gaps(halfway);
  if (is_in_arc(halfway)) threshold.raise(at_middle.forth);
  if (!arc_) threshold.raise(at_middle.back);
  const OppositeGaps anywhere = gaps(n);
  // Since dφ <= dt, the largest slope of all smooth parts bounds the change of g.
  const Interval half_piece = (Interval(piece.hi) - Interval(piece.lo)) * Interval(0.5);
  const auto is_below = [&](const Interval& middle, const Interval& slope, const Interval& gap) {
    return threshold.is_above(gap) ||
           threshold.is_above(middle + abs(slope / n.length) * half_piece);
  };
  if (is_below(at_middle.forth, any_slope + centres, anywhere.forth)) open.forth = 0;
  if (is_below(at_middle.back, any_slope - centres, anywhere.back)) open.back = 0;
  return open;
}

LineSlope<Interval> LineSearch::slope(unsigned vertex, int branch) const {
  Planar q = d_;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto& s = segments_[i];
    const Interval end = (vertex >> i & 1U) ? s.half_length : -s.half_length;
    q = {q.e - end * s.axis.e, q.f - end * s.axis.f};
  }
  const Disc& u = discs_[*tilted_disc_];
  return {{q.f, -q.e}, {u.axis.f, -u.axis.e}, u.along, Interval(branch) * u.radius, is_flat_};
}

bool LineSearch::reaches(const Piece& piece, const GapThreshold& threshold) const {
  return !threshold.is_above(gaps(direction(piece, Interval(piece.lo, piece.hi))).forth);
}

namespace {

/// Cosine and sine from t = tan(angle/2) within [-1, 1], where the sine is monotone and the cosine
/// decreases with |t|.
Angle<Interval> half_angle(double lo, double hi) {
  const auto cosine = [](double t) {
    const Interval square_t = square(Interval(t));
    return (Interval(1) - square_t) / (Interval(1) + square_t);
  };
  const auto sine = [](double t) {
    return Interval(2) * Interval(t) / (Interval(1) + square(Interval(t)));
  };
  const double near = lo <= 0 && 0 <= hi ? 0 : std::min(std::abs(lo), std::abs(hi));
  const double far = std::max(std::abs(lo), std::abs(hi));
  return {{cosine(far).inf(), cosine(near).sup()}, {sine(lo).inf(), sine(hi).sup()}};
}

}  // namespace

RimSearch::RimSearch(const IntervalDifference& difference, unsigned signs)
    : difference_(difference),
      q_(reduced_point(difference, signs)),
      axis2_(difference.discs[1].frame.axis),
      radius1_(difference.discs[0].radius),
      radius2_(difference.discs[1].radius),
      side1_((signs & 1U) ? 1 : -1),
      side2_((signs & 2U) ? 1 : -1) {}

// Rim 1 is body A's, in whose frame its axis is z.
RimSearch::Point RimSearch::at(unsigned turn, double lo, double hi) const {
  Point p{half_angle(lo, hi), {}, {}, {}, {}};
  if (turn == 1) p.angle = {-p.angle.cosine, -p.angle.sine};
  p.w = {radius1_ * p.angle.cosine - q_.x, radius1_ * p.angle.sine - q_.y, -q_.z};
  p.w_u = dot(p.w, axis2_);
  p.off_axis = p.w - p.w_u * axis2_;
  p.off_axis_length = norm(p.off_axis);
  return p;
}

RimSlope<Interval> RimSearch::slope(int branch) const {
  const auto& disc1 = difference_.discs[0];
  const auto& disc2 = difference_.discs[1];
  const auto place = [&](const IntervalVector& axis) -> RimSlope<Interval>::Place {
    return {-dot(q_, axis),
            {disc1.radius * dot(disc1.frame.e, axis), disc1.radius * dot(disc1.frame.f, axis)}};
  };
  const auto x = place(disc2.frame.e), y = place(disc2.frame.f);
  // The root of ρ²'s mean over rim 1.
  const Interval mean =
      square(x.centre) + square(y.centre) +
      (square(x.p.cosine) + square(x.p.sine) + square(y.p.cosine) + square(y.p.sine)) *
          Interval(0.5);
  const double inverse_length = 1 / std::sqrt(mean.sup());
  return {{-dot(q_, disc1.frame.f), dot(q_, disc1.frame.e)},
          x,
          y,
          Interval(branch) * disc2.radius / disc1.radius,
          Interval(inverse_length)};
}

/// Raises the threshold to the gaps along the directions at the middle of a piece.
void RimSearch::sample(const Piece& piece, GapThreshold& threshold) const {
  const double middle = (piece.lo + piece.hi) / 2;
  const Point p = at(piece.turn, middle, middle);
  if (!(p.off_axis_length.inf() > 0)) return;
  const auto gaps = difference_.gaps(p.w - (radius2_ / p.off_axis_length) * p.off_axis);
  threshold.raise(gaps.forth);
  threshold.raise(gaps.back);
}

bool RimSearch::is_open(const Piece& piece, GapThreshold& threshold) const {
  const Point p = at(piece.turn, piece.lo, piece.hi);
  const Interval anywhere(-1, 1);
  const bool on_axis = !(p.off_axis_length.inf() > 0);
  // Along rim 1's tangent and radius.
  const auto along_tangent = [&](const IntervalVector& v) {
    return v.y * p.angle.cosine - v.x * p.angle.sine;
  };
  const auto along_radius = [&](const IntervalVector& v) {
    return v.x * p.angle.cosine + v.y * p.angle.sine;
  };

  // y: unit, from rim 2's centre to its point nearest to rim 1's.
  const Interval q_t = along_tangent(q_);
  const Interval y_t =
      on_axis ? anywhere : -(q_t + p.w_u * along_tangent(axis2_)) / p.off_axis_length;
  const Interval slope = q_t + radius2_ * y_t;
  if (slope.inf() > 0 || slope.sup() < 0) return false;

  const Interval beyond =
      p.off_axis_length - radius2_;  // distance of rim 1's point beyond rim 2's, seen along u2
  const Interval distance = square_root<Interval>(square(p.w_u) + square(beyond));
  IntervalVector y{anywhere, anywhere, anywhere};
  if (!on_axis) y = (Interval(1) / p.off_axis_length) * p.off_axis;
  const Interval apart_radial = radius1_ - along_radius(q_) - radius2_ * along_radius(y);
  const Interval apart_up = side1_ * (-q_.z - radius2_ * y.z);
  const Interval apart_u = side2_ * p.w_u;
  // The direction from rim 2's point to rim 1's has the gap −distance, its opposite +distance, both
  // less the inflation.
  // The comparisons are written so that NaN excludes nothing.
  const Interval inflation = difference_.inflation;
  const bool not_inside = threshold.is_above(-distance - inflation) || apart_radial.sup() < 0 ||
                          beyond.inf() > 0 || apart_up.sup() < 0 || apart_u.sup() < 0;
  const bool not_outside = threshold.is_above(distance - inflation) || apart_radial.inf() > 0 ||
                           beyond.sup() < 0 || apart_up.inf() > 0 || apart_u.inf() > 0;
  if (not_inside && not_outside) return false;
  sample(piece, threshold);
  return true;
}

}  // namespace touchstone::oracle
