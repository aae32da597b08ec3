#include "oracle/ball.hpp"

#include <flint/fmpq.h>

namespace touchstone::oracle {
namespace {

/// Owners of FLINT's integers, rationals and floats.
struct Integer {
  Integer() { fmpz_init(value); }
  explicit Integer(const mpz_class& z) : Integer() { fmpz_set_mpz(value, z.get_mpz_t()); }
  ~Integer() { fmpz_clear(value); }
  Integer(const Integer&) = delete;
  Integer& operator=(const Integer&) = delete;
  fmpz_t value;
};

struct Rational {
  Rational() { fmpq_init(value); }
  explicit Rational(const mpq_class& q) : Rational() { fmpq_set_mpq(value, q.get_mpq_t()); }
  ~Rational() { fmpq_clear(value); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
  fmpq_t value;
};

struct Float {
  Float() { arf_init(value); }
  ~Float() { arf_clear(value); }
  Float(const Float&) = delete;
  Float& operator=(const Float&) = delete;
  arf_t value;
};

mpq_class exact(const arf_t value) {
  Rational q;
  arf_get_fmpq(q.value, value);
  mpq_class result;
  fmpq_get_mpq(result.get_mpq_t(), q.value);
  return result;
}

}  // namespace

thread_local long WorkingPrecision::current_ = 64;

Ball::Ball(const mpz_class& exact) : Ball() {
  const Integer z(exact);
  arb_set_fmpz(value_, z.value);
}

Ball::Ball(const mpz_class& value, long bits) : Ball() {
  const Integer z(value);
  arb_set_round_fmpz(value_, z.value, bits);
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
mpq_class Ball::lower() const {
  Float end;
  arb_get_lbound_arf(end.value, value_, WorkingPrecision::bits());
  return exact(end.value);
}

mpq_class Ball::upper() const {
  Float end;
  arb_get_ubound_arf(end.value, value_, WorkingPrecision::bits());
  return exact(end.value);
}

double Ball::midpoint() const { return arf_get_d(arb_midref(value_), ARF_RND_NEAR); }

BallVector to_balls(const Vector3<mpz_class>& v) { return {Ball(v.x), Ball(v.y), Ball(v.z)}; }

}  // namespace touchstone::oracle
