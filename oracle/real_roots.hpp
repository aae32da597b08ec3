#pragma once

#include <gmpxx.h>
#include <vector>

#include "oracle/ball.hpp"
#include "oracle/root_isolation.hpp"

namespace touchstone::oracle {

Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const mpz_class& a, const Polynomial& b);
bool is_zero(const Polynomial& p);
Ball value_at(const Polynomial& p, const Ball& x);

/// One real root of a polynomial: a simple one, and the only one in its isolating interval.
class RealRoot {
 public:
  /// `lo` < `hi` with a sign change between them, or lo == hi and the root itself.
  RealRoot(Polynomial polynomial, mpq_class lo, mpq_class hi);

  /// The root in a ball of width at most 2^-bits · max(1, |root|), bits being the working
  /// precision. Narrows the isolating interval for the calls that follow: interval Newton in ball
  /// arithmetic, and exact bisection where it stalls (roots that lie close together).
  Ball enclose();

  /// Is this root exactly that number?
  bool is(const mpq_class& number) const;

  /// Is this root a root of another polynomial as well, exactly?
  bool is_root_of(const Polynomial& other) const;

 private:
  bool newton_step(long bits);
  void bisect();

  Polynomial polynomial_, derivative_;
  mpq_class lo_, hi_;
  int sign_at_lo_;
};

/// The real roots in [lo, hi] of a polynomial that is not zero, each once whatever its
/// multiplicity. Where Descartes' rule of signs allows none or one root in the interval, that
/// settles it.
std::vector<RealRoot> real_roots(const Polynomial& polynomial, const mpq_class& lo,
                                 const mpq_class& hi);

}  // namespace touchstone::oracle
