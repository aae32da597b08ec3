#include "oracle/slope_root.hpp"

#include <stdexcept>
#include <vector>

namespace touchstone::oracle {
namespace {

int sign(const Ball& x) { return x.is_positive() ? 1 : x.is_negative() ? -1 : 0; }

/// An owner of one of arb's floats.
struct Point {
  Point() { arf_init(value); }
  explicit Point(double x) : Point() { arf_set_d(value, x); }
  ~Point() { arf_clear(value); }
  Point(const Point&) = delete;
  Point& operator=(const Point&) = delete;

  Ball ball() const {
    Ball result;
    arb_set_arf(result.get(), value);
    return result;
  }
  arf_t value;
};

Ball middle_of(const Ball& x) {
  Ball middle;
  arb_get_mid_arb(middle.get(), x.get());
  return middle;
}

}  // namespace

CurveRoot::CurveRoot(const SlopeBracket& bracket) : bracket_(bracket) {
  const Point lo(bracket.lo), hi(bracket.hi);
  arb_set_interval_arf(t_.get(), lo.value, hi.value, WorkingPrecision::bits());
}

bool CurveRoot::is_narrow(long bits) const {
  return mag_cmp_2exp_si(arb_radref(t_.get()), -bits - 1) <= 0;
}

bool CurveRoot::may_be(const mpq_class& number) const {
  return !bracket_ || (t_ - Ball(number)).contains_zero();
}

void CurveRoot::narrow(const SlopeInBalls& slope, long wanted_bits) {
  while (!is_narrow(wanted_bits) && (newton_step(slope) || trisect(slope))) {
  }
}

/// Interval Newton. False if it does not halve the ball.
bool CurveRoot::newton_step(const SlopeInBalls& slope) {
  const Ball change = slope.change(t_);
  if (change.contains_zero()) return false;
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
  if (halved) t_ = narrowed;
  return halved;
}

/// Cuts off what the slope's signs at two points inside say: the root may be one of them, but not
/// both. False if neither sign is certain at this precision.
bool CurveRoot::trisect(const SlopeInBalls& slope) {
  Point lo, hi, offset;
  arb_get_lbound_arf(lo.value, t_.get(), WorkingPrecision::bits());
  arb_get_ubound_arf(hi.value, t_.get(), WorkingPrecision::bits());
  arf_set_mag(offset.value, arb_radref(t_.get()));
  arf_mul_2exp_si(offset.value, offset.value, -2);
  const int sign_at_lo = bracket_->rising ? -1 : 1;
  bool moved = false;
  for (const bool below : {true, false}) {
    Point at;
    if (below) {
      arf_sub(at.value, arb_midref(t_.get()), offset.value, ARF_PREC_EXACT, ARF_RND_DOWN);
    } else {
      arf_add(at.value, arb_midref(t_.get()), offset.value, ARF_PREC_EXACT, ARF_RND_DOWN);
    }
    const int here = sign(slope.value(at.ball()));
    if (here == 0) continue;
    moved = true;
    Point& end = here == sign_at_lo ? lo : hi;
    // With the root below the lower point, the upper one only confirms it.
    if (here == sign_at_lo || arf_cmp(at.value, hi.value) < 0) arf_set(end.value, at.value);
  }
  if (moved) arb_set_interval_arf(t_.get(), lo.value, hi.value, WorkingPrecision::bits());
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
