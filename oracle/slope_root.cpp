#include "oracle/slope_root.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace touchstone::oracle {
namespace {

int sign(const Ball& x) { return x.is_positive() ? 1 : x.is_negative() ? -1 : 0; }

Ball ball(const Float& x) {
  Ball result;
  arb_set_arf(result.get(), x.get());
  return result;
}

Ball middle_of(const Ball& x) {
  Ball middle;
  arb_get_mid_arb(middle.get(), x.get());
  return middle;
}

}  // namespace

CurveRoot::CurveRoot(const SlopeBracket& bracket) : bracket_(bracket) {
  const Float lo(bracket.lo), hi(bracket.hi);
  arb_set_interval_arf(t_.get(), lo.get(), hi.get(), WorkingPrecision::bits());
}

bool CurveRoot::is_narrow(long bits) const {
  return mag_cmp_2exp_si(arb_radref(t_.get()), -bits - 1) <= 0;
}

bool CurveRoot::may_be(const mpz_class& numerator, const mpz_class& denominator) const {
  const long bits = WorkingPrecision::bits();
  return !bracket_ || (t_ * Ball(denominator, bits) - Ball(numerator, bits)).contains_zero();
}

double CurveRoot::width_bits() const { return -mag_get_d_log2_approx(arb_radref(t_.get())); }

void CurveRoot::narrow(const SlopeInBalls& slope, long wanted_bits) {
  while (!is_narrow(wanted_bits) && (newton(slope, wanted_bits) || trisect(slope))) {
  }
}

/// The slope's change anywhere in the ball. The ball's width limits how well it can be known: more
/// digits than that would be in vain.
Ball CurveRoot::change(const SlopeInBalls& slope) const {
  constexpr long guard_bits = 16, min_bits = 64;
  const long enough = std::max(min_bits, static_cast<long>(width_bits()) + guard_bits);
  if (enough < WorkingPrecision::bits()) {
    const WorkingPrecision precision(enough);
    Ball result = slope.change(t_);
    if (!result.contains_zero()) return result;
  }
  return slope.change(t_);
}

/// Interval Newton, once more with the same change if that is enough. False if it does not halve
/// the ball.
bool CurveRoot::newton(const SlopeInBalls& slope, long wanted_bits) {
  const Ball wide_change = change(slope);
  if (wide_change.contains_zero()) return false;
  bool halved = false;
  for (;;) {
    const double before = width_bits();
    if (!newton_step(slope, wide_change)) return halved;
    halved = true;
    const double gain = width_bits() - before;
    if (is_narrow(wanted_bits) || width_bits() + gain < static_cast<double>(wanted_bits + 1)) {
      return true;
    }
  }
}

/// `change` holds for the ball or a wider one. False if the ball is not halved.
bool CurveRoot::newton_step(const SlopeInBalls& slope, const Ball& change) {
  const Ball middle = middle_of(t_);
  const Ball next = middle - slope.value(middle) / change;
  if (!next.is_finite()) return false;
  Ball narrowed;
  // Both contain the root.
  if (arb_intersection(narrowed.get(), t_.get(), next.get(), WorkingPrecision::bits()) == 0) {
    throw std::logic_error("oracle: a slope's root is lost");
  }
  mag_t half;
  mag_init(half);
  mag_mul_2exp_si(half, arb_radref(t_.get()), -1);
  const bool halved = mag_cmp(arb_radref(narrowed.get()), half) <= 0;
  mag_clear(half);
  if (halved) t_ = std::move(narrowed);
  return halved;
}

/// Cuts off what the slope's signs at two points inside say: the root may be one of them, but not
/// both. False if neither sign is certain at this precision.
bool CurveRoot::trisect(const SlopeInBalls& slope) {
  Float lo = t_.lower_end(), hi = t_.upper_end(), offset, middle;
  arf_set_mag(offset.get(), arb_radref(t_.get()));
  arf_mul_2exp_si(offset.get(), offset.get(), -2);
  arf_set(middle.get(), arb_midref(t_.get()));
  const int sign_at_lo = bracket_->rising ? -1 : 1;
  bool moved = false;
  for (const bool below : {true, false}) {
    const Float at = below ? middle - offset : middle + offset;
    const int here = sign(slope.value(ball(at)));
    if (here == 0) continue;
    moved = true;
    Float& end = here == sign_at_lo ? lo : hi;
    // With the root below the lower point, the upper one only confirms it.
    if (here == sign_at_lo || at < hi) end = at;
  }
  if (moved) arb_set_interval_arf(t_.get(), lo.get(), hi.get(), WorkingPrecision::bits());
  return moved;
}

bool CurveRoot::take_only_root(const Polynomial& polynomial) {
  const mpq_class lo = t_.lower(), hi = t_.upper();
  if (lo == hi) {
    exact_.emplace(square_free(polynomial), lo, hi);
    return true;
  }
  std::vector<RealRoot> roots = real_roots(polynomial, lo, hi);
  if (roots.empty()) throw std::logic_error("oracle: a slope's root is none of the polynomial's");
  if (roots.size() > 1) return false;
  exact_ = std::move(roots.front());
  return true;
}

}  // namespace touchstone::oracle
