// The roots of a slope in double intervals: bisection until the slope is monotone, then interval
// Newton. A root is proven by the signs at both ends of a piece on which the slope is monotone.
#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "oracle/curve_search.hpp"

namespace touchstone::oracle {
namespace {

/// Turns an angle by that many quarters.
Angle<Interval> turned(const Angle<Interval>& a, unsigned quarters) {
  switch (quarters) {
    case 0:
      return a;
    case 1:
      return {-a.sine, a.cosine};
    case 2:
      return {-a.cosine, -a.sine};
    default:
      return {a.sine, -a.cosine};
  }
}

int sign(const Interval& x) { return x.inf() > 0 ? 1 : x.sup() < 0 ? -1 : 0; }

template <class Slope>
class SlopeIsolation {
 public:
  SlopeIsolation(const Slope& slope, unsigned turn)
      : slope_(slope), quarters_(Slope::parameter == AngleParameter::tangent ? turn : 2 * turn) {
    if constexpr (Slope::parameter == AngleParameter::tangent) find_bend();
  }

  bool run(double lo, double hi, int branch, std::vector<SlopeBracket>& out);

 private:
  struct Part {
    double lo, hi;
    int sign_at_lo, sign_at_hi;  // certain
  };
  Angle<Interval> angle(const Interval& t) const {
    return turned(angle_of(Slope::parameter, t), quarters_);
  }
  Interval value(double t) const { return slope_.value(angle(t)); }
  Interval change(const Interval& t) const {
    return slope_.change(angle(t)) * angle_per_parameter(Slope::parameter, t);
  }
  void find_bend();
  double cut(const Part& part) const;
  bool move_outward(double& end, double step, int& sign_there) const;
  std::optional<double> between(const Part& part, int& sign_there) const;
  void narrow(SlopeBracket& bracket, Interval change) const;

  const Slope& slope_;
  unsigned quarters_;
  /// Where the slope of a line's gap changes fast: within `bend_radius_` of `bend_`.
  double bend_ = 0, bend_radius_ = std::numeric_limits<double>::infinity();
};

/// Around the zero of x, within a few |y|: elsewhere ρ is nearly |x|.
template <class Slope>
void SlopeIsolation<Slope>::find_bend() {
  if (slope_.is_flat) return;
  constexpr double several = 16;
  const bool odd = quarters_ % 2 == 1;
  const double e = slope_.x.cosine.sup(), f = slope_.x.sine.sup();
  const double numerator = odd ? f : -e, denominator = odd ? e : f;
  const double radius = several * std::abs(slope_.y.sup() / denominator);
  if (!(radius < 1) || !(std::abs(numerator) < std::abs(denominator))) return;
  bend_ = numerator / denominator;
  bend_radius_ = radius;
}

/// Where to split a part: at the ends of the bend, and outside it by the geometric mean of the
/// distances from it, so that a few splits lead from any scale to that of the bend.
template <class Slope>
double SlopeIsolation<Slope>::cut(const Part& part) const {
  for (const double end : {bend_ - bend_radius_, bend_ + bend_radius_}) {
    if (part.lo < end && end < part.hi) return end;
  }
  const double lo = part.lo - bend_, hi = part.hi - bend_;
  if (lo > 0 && hi > 4 * lo) return bend_ + std::sqrt(lo) * std::sqrt(hi);
  if (hi < 0 && lo < 4 * hi) return bend_ - std::sqrt(-lo) * std::sqrt(-hi);
  return part.lo + 0.5 * (part.hi - part.lo);
}

/// Moves the end of a piece to a near point outside it at which the slope's sign is certain.
template <class Slope>
bool SlopeIsolation<Slope>::move_outward(double& end, double step, int& sign_there) const {
  for (const double factor : {1.0, 3.0, 9.0}) {
    const double t = end + factor * step;
    sign_there = sign(value(t));
    if (sign_there == 0) continue;
    end = t;
    return true;
  }
  return false;
}

/// A point inside at which the slope's sign is certain.
template <class Slope>
std::optional<double> SlopeIsolation<Slope>::between(const Part& part, int& sign_there) const {
  const double first = cut(part);
  for (const double towards_hi : {0.0, 0.375, -0.3125}) {
    const double t = first + towards_hi * (towards_hi > 0 ? part.hi - first : first - part.lo);
    sign_there = sign(value(t));
    if (sign_there != 0 && part.lo < t && t < part.hi) return t;
  }
  return std::nullopt;
}

/// Interval Newton, and bisection where that gains little: the slope may be far from linear.
template <class Slope>
void SlopeIsolation<Slope>::narrow(SlopeBracket& bracket, Interval change_here) const {
  constexpr double gain = 0.25;
  const int sign_at_lo = bracket.rising ? -1 : 1;
  for (;;) {
    const double width = bracket.hi - bracket.lo, middle = bracket.lo + width / 2;
    const Interval there = value(middle);
    if (sign(change_here) != 0) {
      const Interval next = Interval(middle) - there / change_here;
      bracket.lo = std::max(bracket.lo, next.inf());
      bracket.hi = std::min(bracket.hi, next.sup());
    }
    if (!(bracket.hi - bracket.lo <= gain * width)) {
      if (sign(there) == 0) return;
      if (sign(there) == sign_at_lo) bracket.lo = std::max(bracket.lo, middle);
      if (sign(there) == -sign_at_lo) bracket.hi = std::min(bracket.hi, middle);
    }
    if (!(bracket.hi - bracket.lo < width)) return;
    change_here = change(Interval(bracket.lo, bracket.hi));
  }
}

template <class Slope>
bool SlopeIsolation<Slope>::run(double lo, double hi, int branch, std::vector<SlopeBracket>& out) {
  constexpr int max_parts = 96;
  constexpr double margin = 0x1p-20;
  const double step = margin * (hi - lo);
  Part whole{lo, hi, 0, 0};
  if (!move_outward(whole.lo, -step, whole.sign_at_lo)) return false;
  if (!move_outward(whole.hi, step, whole.sign_at_hi)) return false;

  boost::container::static_vector<Part, max_parts> open{whole};
  for (int parts = 0; !open.empty(); ++parts) {
    if (parts == max_parts) return false;
    const Part part = open.back();
    open.pop_back();
    const Interval range(part.lo, part.hi);
    const Interval change_here = change(range);
    if (sign(change_here) != 0) {
      if (part.sign_at_lo == part.sign_at_hi) continue;
      SlopeBracket bracket{part.lo, part.hi, branch, part.sign_at_lo < 0};
      narrow(bracket, change_here);
      out.push_back(bracket);
      continue;
    }
    if (sign(slope_.value(angle(range))) != 0) continue;
    int sign_there = 0;
    const auto middle = between(part, sign_there);
    if (!middle) return false;
    open.push_back({*middle, part.hi, sign_there, part.sign_at_hi});
    open.push_back({part.lo, *middle, part.sign_at_lo, sign_there});
  }
  return true;
}

}  // namespace

bool isolate_slope_roots(const LineSlope<Interval>& slope, int branch, const Piece& piece,
                         std::vector<SlopeBracket>& out) {
  return SlopeIsolation(slope, piece.turn).run(piece.lo, piece.hi, branch, out);
}

bool isolate_slope_roots(const RimSlope<Interval>& slope, int branch, const Piece& piece,
                         std::vector<SlopeBracket>& out) {
  return SlopeIsolation(slope, piece.turn).run(piece.lo, piece.hi, branch, out);
}

}  // namespace touchstone::oracle
