#pragma once

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

template <class Number>
struct Angle {
  Number cosine, sine;
};

/// The angle of t. With half tangents Number has no square root to take.
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

/// constant + cosine cos φ + sine sin φ
template <class Number>
struct Harmonic {
  Number constant, cosine, sine;

  Number periodic(const Angle<Number>& a) const { return cosine * a.cosine + sine * a.sine; }
  Number value(const Angle<Number>& a) const { return constant + periodic(a); }
  Number slope(const Angle<Number>& a) const { return sine * a.cosine - cosine * a.sine; }
};

/// The function whose roots are the critical directions of one curve, up to a positive factor:
///
///   S(φ) = L(φ) − κ ρ'(φ),   ρ = |(x, y)|,
///
/// with L, x and y harmonic. Its sign of κ is the branch of a square root.
///
/// - Directions n across a line: q·n − radius |u × n| has the slope q·n' − radius ρ', where u's
///   part across n has the coordinates x = u·n' and y = u·line.
/// - A point w (from rim 2's centre) of rim 1, and the point y of rim 2 nearest to it (κ > 0) or
///   farthest from it: half the squared distance has the slope −q·t − (±radius2/radius1) ρ', where
///   w's part across rim 2's axis has the length ρ, and t is rim 1's tangent.
///
/// Both branches multiplied give the polynomial of real_roots.hpp. For nearly parallel axes ρ' is
/// nearly zero, so that each root of one branch has one of the other beside it: a cluster for the
/// polynomial, but a simple root of S.
template <class Number>
struct StationarySlope {
  Harmonic<Number> linear, x, y;
  Number factor;  ///< κ
  /// y is exactly zero, so that ρ = |x|. S is then continued smoothly through the zero of x, where
  /// the branches change places: ρ' is replaced by x'.
  bool is_flat = false;

  Number value(const Angle<Number>& a) const {
    if (is_flat) return linear.periodic(a) - factor * x.slope(a);
    const Number u = x.value(a), v = y.value(a);
    const Number length = square_root<Number>(square(u) + square(v));
    return linear.periodic(a) - factor * ((u * x.slope(a) + v * y.slope(a)) / length);
  }

  /// dS/dφ. Since x'' = −(x − constant), ρ'' = (x y' − y x')²/ρ³ − (x, y)·(periodic parts)/ρ,
  /// without cancellation where ρ is small.
  Number change(const Angle<Number>& a) const {
    if (is_flat) return linear.slope(a) + factor * x.periodic(a);
    const Number px = x.periodic(a), py = y.periodic(a);
    const Number u = x.constant + px, v = y.constant + py;
    const Number squared = square(u) + square(v);
    const Number length = square_root(squared);
    const Number turning = square(u * y.slope(a) - v * x.slope(a)) / squared;
    return linear.slope(a) - factor * ((turning - (u * px + v * py)) / length);
  }
};

}  // namespace touchstone::oracle
