// The roots of a slope in double intervals: bisection until the slope is monotone, then interval
// Newton. A root is proven by the signs at both ends of a piece on which the slope is monotone.
#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <optional>

#include "oracle/curve_search.hpp"

namespace touchstone::oracle {
namespace {

/// The angle along a curve of which the parameter begins anew after so many quarter turns.
Angle<Interval> angle_after(unsigned quarters, AngleParameter parameter, const Interval& t) {
  const Angle<Interval> a = angle_of(parameter, t);
  const auto [cosine, sine] = turned(a.cosine, a.sine, quarters);
  return {cosine, sine};
}

int sign(const Interval& x) { return x.inf() > 0 ? 1 : x.sup() < 0 ? -1 : 0; }

/// A slope as a function of its curve's parameter, in the form that is tightest there.
class LineOfParameter {
 public:
  LineOfParameter(const LineSlope<Interval>& slope, unsigned turn)
      : forms_{slope.beside(-1), slope, slope.beside(1)}, turn_(turn) {}

  Interval value(const Interval& t) const {
    const Angle<Interval> a = angle(t);
    return form(a).value(a);
  }
  Interval change(const Interval& t) const {
    const Angle<Interval> a = angle(t);
    return form(a).change(a) * angle_per_parameter(AngleParameter::tangent, t);
  }

 private:
  Angle<Interval> angle(const Interval& t) const {
    return angle_after(turn_, AngleParameter::tangent, t);
  }
  const LineSlope<Interval>& form(const Angle<Interval>& a) const {
    const Interval x = forms_[1].x(a);
    const double beside = abs(forms_[1].y()).sup();
    return forms_[x.inf() > beside ? 2 : x.sup() < -beside ? 0 : 1];
  }

  std::array<LineSlope<Interval>, 3> forms_;
  unsigned turn_;
};

class RimOfParameter {
 public:
  RimOfParameter(const RimSlope<Interval>& slope, unsigned turn) : slope_(slope), turn_(turn) {}

  Interval value(const Interval& t) const { return slope_.value(angle(t)); }
  Interval change(const Interval& t) const {
    return slope_.change(angle(t)) * angle_per_parameter(AngleParameter::half_tangent, t);
  }

 private:
  Angle<Interval> angle(const Interval& t) const {
    return angle_after(2 * turn_, AngleParameter::half_tangent, t);
  }

  const RimSlope<Interval>& slope_;
  unsigned turn_;
};

template <class Slope>
class SlopeIsolation {
 public:
  explicit SlopeIsolation(const Slope& slope) : slope_(slope) {}

  bool run(double lo, double hi, int branch, std::vector<SlopeBracket>& out);

 private:
  struct Part {
    double lo, hi;
    int sign_at_lo, sign_at_hi;  // certain
  };
  bool move_outward(double& end, double step, int& sign_there) const;
  std::optional<double> between(const Part& part, Interval& there) const;
  void narrow(SlopeBracket& bracket, Interval change) const;

  const Slope& slope_;
};

/// Moves the end of a piece to a near point outside it at which the slope's sign is certain.
template <class Slope>
bool SlopeIsolation<Slope>::move_outward(double& end, double step, int& sign_there) const {
  for (const double factor : {1.0, 3.0, 9.0}) {
    const double t = end + factor * step;
    sign_there = sign(slope_.value(t));
    if (sign_there == 0) continue;
    end = t;
    return true;
  }
  return false;
}

/// A point inside at which the slope's sign is certain, and the slope there.
template <class Slope>
std::optional<double> SlopeIsolation<Slope>::between(const Part& part, Interval& there) const {
  for (const double at : {0.5, 0.6875, 0.34375}) {
    const double t = part.lo + at * (part.hi - part.lo);
    there = slope_.value(t);
    if (sign(there) != 0 && part.lo < t && t < part.hi) return t;
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
    const Interval there = slope_.value(middle);
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
    change_here = slope_.change(Interval(bracket.lo, bracket.hi));
  }
}

template <class Slope>
bool SlopeIsolation<Slope>::run(double lo, double hi, int branch, std::vector<SlopeBracket>& out) {
  constexpr int max_parts = 256;
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
    const Interval change_here = slope_.change(range);
    if (sign(change_here) != 0) {
      if (part.sign_at_lo == part.sign_at_hi) continue;
      SlopeBracket bracket{part.lo, part.hi, branch, part.sign_at_lo < 0};
      narrow(bracket, change_here);
      out.push_back(bracket);
      continue;
    }
    if (sign(slope_.value(range)) != 0) continue;
    Interval there = 0;
    const auto middle = between(part, there);
    if (!middle) return false;
    if (sign(there + change_here * (range - Interval(*middle))) != 0) continue;
    open.push_back({*middle, part.hi, sign(there), part.sign_at_hi});
    open.push_back({part.lo, *middle, part.sign_at_lo, sign(there)});
  }
  return true;
}

}  // namespace

bool isolate_slope_roots(const LineSlope<Interval>& slope, int branch, const Piece& piece,
                         std::vector<SlopeBracket>& out) {
  const LineOfParameter line(slope, piece.turn);
  return SlopeIsolation(line).run(piece.lo, piece.hi, branch, out);
}

bool isolate_slope_roots(const RimSlope<Interval>& slope, int branch, const Piece& piece,
                         std::vector<SlopeBracket>& out) {
  const RimOfParameter rim(slope, piece.turn);
  return SlopeIsolation(rim).run(piece.lo, piece.hi, branch, out);
}

}  // namespace touchstone::oracle
