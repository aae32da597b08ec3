#pragma once

#include <optional>
#include <utility>

#include "oracle/ball.hpp"
#include "oracle/real_roots.hpp"

namespace touchstone::oracle {

/// How the angle φ along a curve of directions follows from its parameter t.
enum class AngleParameter {
  tangent,      ///< t = tan φ: the circle of directions across a line
  half_tangent  ///< t = tan(φ/2): the points of a rim
};

template <class Number>
Number square_root(const Number& x) {
  return sqrt(x);
}

/// x / |(x, y)|
template <class Number>
Number cosine_towards(const Number& x, const Number& y) {
  return x / square_root<Number>(square(x) + square(y));
}

template <class Number>
struct Angle {
  Number cosine, sine;
};

template <class Number>
Angle<Number> angle_of(AngleParameter parameter, const Number& t) {
  const Number scale = Number(1) / (Number(1) + square(t));
  if (parameter == AngleParameter::half_tangent) {
    return {(Number(1) - square(t)) * scale, Number(2) * t * scale};
  }
  const Number cosine = square_root(scale);
  return {cosine, t * cosine};
}

/// dφ/dt > 0
template <class Number>
Number angle_per_parameter(AngleParameter parameter, const Number& t) {
  return Number(parameter == AngleParameter::tangent ? 1 : 2) / (Number(1) + square(t));
}

/// cosine cos φ + sine sin φ
template <class Number>
struct Harmonic {
  Number cosine, sine;

  Number value(const Angle<Number>& a) const { return cosine * a.cosine + sine * a.sine; }
  Number slope(const Angle<Number>& a) const { return sine * a.cosine - cosine * a.sine; }
};

/// The slope of the gap along the circle of directions n across a line, whose roots are critical
/// directions. At one vertex, with the reduced point q and one disc that is not perpendicular to
/// the line,
///
///   S(φ) = q·n' − κ ρ',   ρ = |u × n| = |(x, y)|,   x = u·n',   y = u·line,
///
/// where κ is the disc's radius. Negative κ is the other branch of the square root: both slopes
/// multiplied give the quartic of one_rim_directions.cpp. For u nearly along the line ρ' is nearly
/// zero, so that each root of one branch has one of the other beside it: a cluster for the quartic,
/// but a simple root of S.
///
/// Where x keeps its sign and y is small, L and κ ρ' may nearly cancel. There `side` is that sign:
///
///   S = (q·n' − κ side x') − κ (x/ρ − side) x',
///
/// of which the first part is one harmonic. Elsewhere `side` is 0.
template <class Number>
class LineSlope {
 public:
  static constexpr AngleParameter parameter = AngleParameter::tangent;

  /// If y is exactly zero, ρ is |x|, and S is continued smoothly through the zero of x, where the
  /// branches change places: ρ' is replaced by x'.
  LineSlope(const Harmonic<Number>& linear, const Harmonic<Number>& x, const Number& y,
            const Number& factor, bool is_flat)
      : linear_(linear), x_(x), y_(y), factor_(factor), is_flat_(is_flat) {
    if (is_flat) take_out(1);
  }

  /// The same slope, for directions at which x has this sign.
  LineSlope beside(int side) const {
    LineSlope result = *this;
    if (!is_flat_ && side != 0) result.take_out(side);
    return result;
  }

  Number x(const Angle<Number>& a) const { return x_.value(a); }
  const Harmonic<Number>& x() const { return x_; }
  const Number& y() const { return y_; }

  Number value(const Angle<Number>& a) const {
    if (is_flat_) return linear_.value(a);
    const Number u = x_.value(a);
    return linear_.value(a) - factor_ * (bent_part(u) * x_.slope(a));
  }

  /// dS/dφ. With x'' = −x, ρ'' = (y x')²/ρ³ − x²/ρ, without cancellation where ρ is small.
  Number change(const Angle<Number>& a) const {
    if (is_flat_) return linear_.slope(a);
    const Number u = x_.value(a);
    const Number squared = square(u) + square(y_);
    const Number bend = square(y_ * x_.slope(a)) / (squared * square_root(squared));
    return linear_.slope(a) - factor_ * (bend - u * bent_part(u));
  }

 private:
  /// x' has the coefficients (sine, −cosine).
  void take_out(int side) {
    side_ = side;
    const Number part = factor_ * Number(side);
    linear_ = {linear_.cosine - part * x_.sine, linear_.sine + part * x_.cosine};
  }
  /// x/ρ − side
  Number bent_part(const Number& u) const {
    if (side_ == 0) return cosine_towards(u, y_);
    const Number length = square_root<Number>(square(u) + square(y_));
    return Number(-side_) * square(y_) / (length * (length + Number(side_) * u));
  }

  Harmonic<Number> linear_, x_;
  Number y_, factor_;
  bool is_flat_;
  int side_ = 0;
};

/// The slope of half the squared distance of a point p of rim 1 from a rim, as p moves along
/// rim 1, whose roots are stationary pairs. With p's place w relative to rim 2's centre, of which
/// the part across rim 2's axis has the coordinates (x, y) and the length ρ,
///
///   S(φ) = L − κ ρ',   L = −q·t,   κ = radius2/radius1,
///
/// where t is rim 1's tangent and q rim 2's centre. Negative κ is the branch of rim 2's farthest
/// point. Both slopes multiplied give the octic of rim_rim_directions.cpp.
///
/// L and κ ρ' nearly cancel where rim 1 is small beside ρ, and where the rims are nearly coaxial.
/// So what is nearly constant of 1/ρ, `inverse_length`, is taken out (any number will do): with
/// ρ ρ' = M + N, where the harmonic M = x0 x' + y0 y' belongs to the centre (x0, y0) and N has the
/// double angle,
///
///   S = (L − κ inverse_length M) − κ ((1/ρ − inverse_length) M + N/ρ).
template <class Number>
class RimSlope {
 public:
  static constexpr AngleParameter parameter = AngleParameter::half_tangent;

  /// The part of w across rim 2's axis is centre + p.
  struct Place {
    Number centre;
    Harmonic<Number> p;
  };
  RimSlope(const Harmonic<Number>& tangential, const Place& x, const Place& y, const Number& factor,
           const Number& inverse_length)
      : x_(x),
        y_(y),
        of_centre_{x.centre * x.p.sine + y.centre * y.p.sine,
                   -(x.centre * x.p.cosine + y.centre * y.p.cosine)},
        factor_(factor),
        inverse_length_(inverse_length) {
    // M = of_centre · (cos, sin), since x' = sine cos φ − cosine sin φ.
    const Number part = factor * inverse_length;
    linear_ = {tangential.cosine - part * of_centre_.cosine,
               tangential.sine - part * of_centre_.sine};
    // N = sine2 cos φ sin φ + cosine2 (cos² φ − sin² φ)
    cosine2_ = x.p.cosine * x.p.sine + y.p.cosine * y.p.sine;
    sine2_ = square(x.p.sine) + square(y.p.sine) - square(x.p.cosine) - square(y.p.cosine);
  }

  Number value(const Angle<Number>& a) const {
    const Number inverse = Number(1) / length(a);
    return linear_.value(a) - factor_ * ((inverse - inverse_length_) * of_centre_.value(a) +
                                         double_angle(a) * inverse);
  }

  /// dS/dφ = L' − κ ρ'', ρ'' = (M' + N' − ρ'²)/ρ
  Number change(const Angle<Number>& a) const {
    const Number inverse = Number(1) / length(a);
    const Number slope = (of_centre_.value(a) + double_angle(a)) * inverse;
    const Number double_angle_slope =
        sine2_ * (square(a.cosine) - square(a.sine)) - Number(4) * cosine2_ * (a.cosine * a.sine);
    return linear_.slope(a) - factor_ * ((inverse - inverse_length_) * of_centre_.slope(a) +
                                         (double_angle_slope - square(slope)) * inverse);
  }

 private:
  Number length(const Angle<Number>& a) const {
    return square_root<Number>(square(x_.centre + x_.p.value(a)) +
                               square(y_.centre + y_.p.value(a)));
  }
  Number double_angle(const Angle<Number>& a) const {
    return sine2_ * (a.cosine * a.sine) + cosine2_ * (square(a.cosine) - square(a.sine));
  }

  Place x_, y_;
  Harmonic<Number> of_centre_, linear_;
  Number factor_, inverse_length_, sine2_, cosine2_;
};

/// A simple root of a slope, the only one between the doubles lo < hi, at
/// which the slope's signs differ.
struct SlopeBracket {
  double lo, hi;
  int branch;   ///< 1 or −1: the sign of κ
  bool rising;  ///< negative at lo, positive at hi
};

/// A slope as a function of the curve's parameter.
template <class Slope>
class SlopeOfParameter : public BallFunction {
 public:
  explicit SlopeOfParameter(Slope slope) : slope_(std::move(slope)) {}
  Ball value(const Ball& t) const override { return slope_.value(angle_of(Slope::parameter, t)); }
  Ball change(const Ball& t) const override {
    return slope_.change(angle_of(Slope::parameter, t)) * angle_per_parameter(Slope::parameter, t);
  }

 private:
  Slope slope_;
};

/// The parameter of a critical direction on its curve: a root of the curve's polynomial, or of the
/// slope of one of its branches. A curve supplies
///
///   Polynomial polynomial() const;
///   LineSlope<Ball> or RimSlope<Ball> slope(int branch) const;  // at the working precision
///   std::optional<Ball> stretch() const;  // of the slope's parameter over the polynomial's, if
///   not 1
class CurveRoot {
 public:
  CurveRoot(RealRoot root) : exact_(std::move(root)) {}
  explicit CurveRoot(const SlopeBracket& bracket)
      : branch_(bracket.branch),
        of_slope_(std::in_place, Float(bracket.lo), Float(bracket.hi), bracket.rising) {}

  /// The sign of κ; 0 for a root of the polynomial, which may belong to either branch.
  int branch() const { return branch_; }

  /// A ball of width at most 2^(RootBracket::spare_bits − bits), times what the parameter is
  /// stretched by, that contains the polynomial's root; `bits` is the working precision.
  template <class Curve>
  Ball enclose(const Curve& curve) {
    if (!of_slope_) return exact_->enclose();
    of_slope_->narrow(WorkingPrecision::bits() - RootBracket::spare_bits,
                      [&] { return SlopeOfParameter(curve.slope(branch_)); });
    return known(curve);
  }

  /// Is the root exactly numerator / denominator?
  template <class Curve>
  bool is(const Curve& curve, const mpz_class& numerator, const mpz_class& denominator) {
    if (of_slope_ && !may_be(known(curve), numerator, denominator)) return false;
    mpq_class number(numerator, denominator);
    number.canonicalize();
    return exact(curve).is(number);
  }
  /// Is the root exactly a root of another polynomial, too?
  template <class Curve>
  bool is_root_of(const Curve& curve, const Polynomial& other) {
    return is_zero(other) || exact(curve).is_root_of(other);
  }

 private:
  /// The bracket of the slope's root, of the polynomial's parameter.
  template <class Curve>
  Ball known(const Curve& curve) const {
    const std::optional<Ball> stretch = curve.stretch();
    return stretch ? of_slope_->ball() / *stretch : of_slope_->ball();
  }
  /// The root as one of the curve's polynomial.
  template <class Curve>
  RealRoot& exact(const Curve& curve) {
    if (exact_) return *exact_;
    const Polynomial polynomial = curve.polynomial();
    for (long bits = 2 * WorkingPrecision::bits();; bits *= 2) {
      const WorkingPrecision precision(bits);
      enclose(curve);
      const bool is_stretched = curve.stretch().has_value();
      const bool is_alone =
          is_stretched
              ? take_only_root(polynomial, known(curve).lower(), known(curve).upper())
              : take_only_root(polynomial, of_slope_->lo().rational(), of_slope_->hi().rational());
      if (is_alone) return *exact_;
    }
  }

  static bool may_be(const Ball& root, const mpz_class& numerator, const mpz_class& denominator);
  bool take_only_root(const Polynomial& polynomial, const mpq_class& lo, const mpq_class& hi);

  int branch_ = 0;
  std::optional<RootBracket> of_slope_;
  std::optional<RealRoot> exact_;
};

}  // namespace touchstone::oracle
