#include "oracle/rim_search.hpp"

#include <algorithm>

namespace touchstone::oracle {
namespace {

Interval length(const IntervalVector& v) { return sqrt(square(v.x) + square(v.y) + square(v.z)); }

struct Angle {
  Interval cosine, sine;
};

/// Both from t = tan(angle/2) within [-1, 1], where the sine is monotone and the cosine falls with
/// |t|.
Angle angle(double lo, double hi) {
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
      q_(difference.d),
      radius1_(difference.discs[0].radius),
      radius2_(difference.discs[1].radius) {
  IntervalVector* ups[] = {&up1_, &up2_};
  for (unsigned i = 0; i < 2; ++i) {
    const auto& s = difference.segments[i];
    *ups[i] = (signs >> i & 1U) ? s.frame.axis : -s.frame.axis;
    q_ = q_ - s.half_length * *ups[i];
  }
}

RimSearch::Point RimSearch::at(unsigned turn, double lo, double hi) const {
  const Angle a = angle(lo, hi);
  const auto& rim1 = difference_.discs[0].frame;
  const auto& axis2 = difference_.discs[1].frame.axis;
  Point p;
  p.radial = a.cosine * rim1.e + a.sine * rim1.f;
  p.tangent = a.cosine * rim1.f - a.sine * rim1.e;
  if (turn == 1) {
    p.radial = -p.radial;
    p.tangent = -p.tangent;
  }
  p.w = radius1_ * p.radial - q_;
  p.w_u = dot(p.w, axis2);
  p.off_axis = p.w - p.w_u * axis2;
  p.off_axis_length = length(p.off_axis);
  return p;
}

/// Raises the bar by the gaps along the directions that the middle of a piece suggests.
void RimSearch::sample(const Piece& piece, Bar& bar) const {
  const double middle = (piece.lo + piece.hi) / 2;
  const Point p = at(piece.turn, middle, middle);
  if (!(p.off_axis_length.inf() > 0)) return;
  for (const double branch : {1.0, -1.0}) {
    const IntervalVector apart =
        p.w - (Interval(branch) * radius2_ / p.off_axis_length) * p.off_axis;
    for (const IntervalVector& n : {apart, -apart}) {
      bar.raise(difference_.gap(n));
    }
  }
}

bool RimSearch::is_open(const Piece& piece, Bar& bar) const {
  const Point p = at(piece.turn, piece.lo, piece.hi);
  const auto& axis2 = difference_.discs[1].frame.axis;
  const Interval anywhere(-1, 1);
  const bool on_axis = !(p.off_axis_length.inf() > 0);
  IntervalVector y{anywhere, anywhere, anywhere};  // from rim 2's centre to the nearer point, unit
  if (!on_axis) y = (Interval(1) / p.off_axis_length) * p.off_axis;

  const Interval q_t = dot(q_, p.tangent);
  const Interval y_t =
      on_axis ? anywhere : -(q_t + p.w_u * dot(axis2, p.tangent)) / p.off_axis_length;
  const Interval y_radial = dot(y, p.radial), y_up = dot(y, up1_);
  const Interval apart_u = dot(p.w, up2_);

  bool open = false;
  for (const double branch : {1.0, -1.0}) {
    const Interval reach = Interval(branch) * radius2_;
    const Interval slope = q_t + reach * y_t;
    if (slope.inf() > 0 || slope.sup() < 0) continue;
    const Interval beyond = p.off_axis_length - reach;  // of the point past rim 2
    const Interval distance = sqrt(square(p.w_u) + square(beyond));
    const Interval apart_radial = radius1_ - dot(q_, p.radial) - reach * y_radial;
    const Interval apart_up = -dot(q_, up1_) - reach * y_up;
    const Interval apart_y = branch * beyond;
    // The direction from rim 2's point to rim 1's has the gap −distance, the other way +distance.
    // Written so that what is not a number excludes nothing.
    const bool not_inside = bar.is_above(-distance) || apart_radial.sup() < 0 ||
                            apart_y.inf() > 0 || apart_up.sup() < 0 || apart_u.sup() < 0;
    const bool not_outside = bar.is_above(distance) || apart_radial.inf() > 0 ||
                             apart_y.sup() < 0 || apart_up.inf() > 0 || apart_u.inf() > 0;
    open = open || !not_inside || !not_outside;
  }
  if (open) sample(piece, bar);
  return open;
}

}  // namespace touchstone::oracle
