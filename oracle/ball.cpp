#include "oracle/ball.hpp"

#include <flint/fmpq.h>
#include <limits>

namespace touchstone::oracle {
namespace {

/// An owner of one of FLINT's rationals.
struct Rational {
  Rational() { fmpq_init(value); }
  explicit Rational(const mpq_class& q) : Rational() { fmpq_set_mpq(value, q.get_mpq_t()); }
  ~Rational() { fmpq_clear(value); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
  fmpq_t value;
};

}  // namespace

mpq_class Float::rational() const {
  Rational q;
  arf_get_fmpq(q.value, value_);
  mpq_class result;
  fmpq_get_mpq(result.get_mpq_t(), q.value);
  return result;
}

double quotient(const Float& a, const Float& b) {
  constexpr long digits = std::numeric_limits<double>::digits;
  Float r;
  arf_div(r.get(), a.get(), b.get(), digits, ARF_RND_DOWN);
  return arf_get_d(r.get(), ARF_RND_DOWN);
}

Ball::Ball(const mpz_class& exact) : Ball() { arf_set_mpz(arb_midref(value_), exact.get_mpz_t()); }

Ball::Ball(const mpz_class& value, long bits) : Ball() {
  if (arf_set_round_mpz(arb_midref(value_), value.get_mpz_t(), bits, ARF_RND_DOWN) != 0) {
    arf_mag_set_ulp(arb_radref(value_), arb_midref(value_), bits);
  }
}

Ball::Ball(const mpq_class& exact) : Ball() {
  const Rational q(exact);
  arb_set_fmpq(value_, q.value, WorkingPrecision::bits());
}

Ball::Ball(const mpq_class& lo, const mpq_class& hi) : Ball() {
  const Ball a(lo), b(hi);
  arb_union(value_, a.value_, b.value_, WorkingPrecision::bits());
}

// Floor and ceil round towards minus and plus infinity. (arb's "down" and "up" round by magnitude.)
Float Ball::lower_end() const {
  Float end;
  arb_get_lbound_arf(end.get(), value_, WorkingPrecision::bits());
  return end;
}

Float Ball::upper_end() const {
  Float end;
  arb_get_ubound_arf(end.get(), value_, WorkingPrecision::bits());
  return end;
}

double Ball::midpoint() const { return arf_get_d(arb_midref(value_), ARF_RND_NEAR); }

BallVector to_balls(const Vector3<mpz_class>& v) {
  const long bits = WorkingPrecision::bits();
  return {Ball(v.x, bits), Ball(v.y, bits), Ball(v.z, bits)};
}

}  // namespace touchstone::oracle
