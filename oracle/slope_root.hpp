#pragma once

#include <optional>
#include <utility>

#include "oracle/ball.hpp"
#include "oracle/real_roots.hpp"
#include "oracle/stationary_slope.hpp"

namespace touchstone::oracle {

/// A simple root of a slope (stationary_slope.hpp), the only one between the doubles lo < hi, at
/// which the slope's signs differ.
struct SlopeBracket {
  double lo, hi;
  int branch;   ///< 1 or −1: the sign of κ
  bool rising;  ///< negative at lo, positive at hi
};

/// A slope as a function of the curve's parameter, at the working precision.
class SlopeInBalls {
 public:
  virtual ~SlopeInBalls() = default;
  virtual Ball value(const Ball& t) const = 0;
  virtual Ball change(const Ball& t) const = 0;
};

template <class Slope>
class SlopeOfParameter : public SlopeInBalls {
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
class CurveRoot {
 public:
  CurveRoot(RealRoot root) : exact_(std::move(root)) {}
  explicit CurveRoot(const SlopeBracket& bracket);

  /// The sign of κ; 0 for a root of the polynomial, which may belong to either branch.
  int branch() const { return bracket_ ? bracket_->branch : 0; }

  /// A ball of width at most 2^-bits · max(1, |root|) that contains the root; `bits` is the working
  /// precision.
  template <class Curve>
  Ball enclose(const Curve& curve) {
    if (!bracket_) return exact_->enclose();
    const long wanted = WorkingPrecision::bits();
    for (long bits = wanted + extra_bits; !is_narrow(wanted); bits += extra_bits) {
      const WorkingPrecision precision(bits);
      narrow(SlopeOfParameter(curve.slope(branch())), wanted);
    }
    return t_;
  }

  /// Is the root exactly this number?
  template <class Curve>
  bool is(const Curve& curve, const mpq_class& number) {
    return may_be(number) && exact(curve).is(number);
  }
  /// Is the root exactly a root of another polynomial, too?
  template <class Curve>
  bool is_root_of(const Curve& curve, const Polynomial& other) {
    return is_zero(other) || exact(curve).is_root_of(other);
  }

 private:
  /// The root as one of the curve's polynomial.
  template <class Curve>
  RealRoot& exact(const Curve& curve) {
    if (exact_) return *exact_;
    const Polynomial polynomial = curve.polynomial();
    for (long bits = 2 * WorkingPrecision::bits();; bits *= 2) {
      const WorkingPrecision precision(bits);
      enclose(curve);
      if (take_only_root(polynomial)) return *exact_;
    }
  }

  bool is_narrow(long bits) const;
  bool may_be(const mpq_class& number) const;
  void narrow(const SlopeInBalls& slope, long wanted_bits);
  bool newton_step(const SlopeInBalls& slope);
  bool trisect(const SlopeInBalls& slope);
  bool take_only_root(const Polynomial& polynomial);

  /// Working precision beyond the wanted one.
  static constexpr long extra_bits = 32;

  std::optional<SlopeBracket> bracket_;
  Ball t_;  ///< with a bracket: contains the root and no other
  std::optional<RealRoot> exact_;
};

}  // namespace touchstone::oracle
