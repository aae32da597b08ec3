#pragma once

#include <gmpxx.h>
#include <vector>

#include "oracle/ball.hpp"

namespace touchstone::oracle {

/// Integer coefficients, constant term first.
using Polynomial = std::vector<mpz_class>;

Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const mpz_class& a, const Polynomial& b);
bool is_zero(const Polynomial& p);

/// One real root of a square-free polynomial: the only one in its isolating interval.
class RealRoot {
 public:
  /// `lo` < `hi` with a sign change between them, or lo == hi and the root itself.
  RealRoot(Polynomial square_free, mpq_class lo, mpq_class hi);

  /// The root in a ball of width at most 2^-bits · max(1, |root|), bits being the working
  /// precision. Narrows the isolating interval for the calls that follow: interval Newton in ball
  /// arithmetic, and exact bisection where it stalls (roots that lie close together).
  Ball enclose();

  /// Is this root exactly that number?
  bool is(const mpq_class& number) const;

 private:
  bool newton_step(long bits);
  void bisect();

  Polynomial polynomial_, derivative_;
  mpq_class lo_, hi_;
  int sign_at_lo_;
};

/// All real roots of a polynomial that is not zero, each once whatever its multiplicity, isolated
/// by CGAL's algebraic kernel (Descartes' rule of signs on the square-free part).
std::vector<RealRoot> real_roots(const Polynomial& polynomial);

}  // namespace touchstone::oracle
