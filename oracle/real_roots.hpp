#pragma once

#include <gmpxx.h>
#include <optional>
#include <utility>
#include <vector>

#include "oracle/ball.hpp"

namespace touchstone::oracle {

/// Integer coefficients, constant term first.
using Polynomial = std::vector<mpz_class>;

/// Sign of p(x).
int sign_at(const Polynomial& p, const mpq_class& x);

/// Rounds a number down or up to a multiple of 2^-bits.
mpq_class on_grid(const mpq_class& x, long bits, bool up);

Polynomial derivative(const Polynomial& p);

/// Greatest common divisor of two polynomials that are not zero, and the polynomial with the same
/// roots as p, all simple. Both are primitive.
Polynomial common_divisor(const Polynomial& p, const Polynomial& q);
Polynomial square_free(const Polynomial& p);

/// A primitive polynomial divided by x − root.
Polynomial without_root(const Polynomial& p, const mpq_class& root);

/// Upper bound, of the same parity, of the number of roots in (lo, hi), counted with multiplicity:
/// Descartes' rule of signs on (1 + x)^k p((lo + hi x)/(1 + x)). Collins and Akritas, "Polynomial
/// real root isolation using Descartes' rule of signs", SYMSAC 1976.
int sign_variations(const Polynomial& p, const mpq_class& lo, const mpq_class& hi);

struct RootInterval {
  mpq_class lo, hi;  ///< the ends are no roots
};

/// Disjoint intervals in rising order, each with one root: they isolate all roots of a square-free
/// polynomial between lo and hi. Precondition: lo and hi are no roots.
///
/// Bisection needs k steps to separate roots 2^-k apart. Here Newton's method with the cluster's
/// multiplicity predicts where the cluster lies; if Descartes' rule proves that no root lies
/// elsewhere, the interval shrinks at once, by a factor that grows with every success: log k steps.
/// Sagraloff and Mehlhorn, "Computing real roots of real polynomials", J. Symbolic Computation 73,
/// 2016.
std::vector<RootInterval> isolate_roots(const Polynomial& p, const mpq_class& lo,
                                        const mpq_class& hi);

Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const mpz_class& a, const Polynomial& b);
bool is_zero(const Polynomial& p);
Ball value_at(const Polynomial& p, const Ball& x);

/// A function of one real number, at the working precision, and its slope.
class BallFunction {
 public:
  virtual ~BallFunction() = default;
  virtual Ball value(const Ball& t) const = 0;
  virtual Ball change(const Ball& t) const = 0;
};

/// An interval with one root of a function and no other, at which the function's sign changes.
class RootBracket {
 public:
  /// Bits of the working precision that rounding in the function may cost.
  static constexpr long spare_bits = 32;

  /// `rising`: the function is negative at `lo`.
  RootBracket(Float lo, Float hi, bool rising)
      : lo_(std::move(lo)), hi_(std::move(hi)), rising_(rising) {}

  const Float& lo() const { return lo_; }
  const Float& hi() const { return hi_; }
  /// At the working precision.
  Ball ball() const;

  /// Narrows the interval to a width of at most 2^-bits: by interval Newton in ball arithmetic, and
  /// by the function's signs where that stalls. `at_precision` makes the function at a working
  /// precision, which begins with `spare_bits` more than wanted, and rises where that does not
  /// suffice (close roots).
  template <class AtPrecision>
  void narrow(long bits, const AtPrecision& at_precision) {
    for (long here = bits + spare_bits; !is_narrow(bits); here += spare_bits) {
      const WorkingPrecision precision(here);
      narrow_here(at_precision(), bits);
    }
  }

 private:
  bool is_narrow(long bits) const;
  /// About −log2 of half the width: predicts when is_narrow, which decides exactly, will hold.
  double width_bits() const;
  void narrow_here(const BallFunction& function, long wanted_bits);
  Ball change(const BallFunction& function) const;
  bool newton(const BallFunction& function, long wanted_bits);
  bool newton_step(const BallFunction& function, const Ball& change);
  bool trisect(const BallFunction& function);

  Float lo_, hi_;  // exact: a ball's radius is rounded, and could reach the next root
  bool rising_;
};

/// One simple real root of a polynomial, the only one in its isolating interval.
class RealRoot {
 public:
  /// Precondition: lo < hi and the polynomial changes sign between them, or lo == hi is the root.
  RealRoot(Polynomial polynomial, mpq_class lo, mpq_class hi);

  /// A ball of width at most 2^-bits that contains the root; `bits` is the working precision.
  Ball enclose();

  /// Is the root exactly this number?
  bool is(const mpq_class& number) const;

  /// Is the root exactly a root of another polynomial, too?
  bool is_root_of(const Polynomial& other) const;

 private:
  Polynomial polynomial_, derivative_;
  mpq_class lo_, hi_;
  std::optional<RootBracket> bracket_;  ///< absent if lo == hi
};

/// The distinct real roots in [lo, hi] of a polynomial that is not zero. Where Descartes' rule of
/// signs allows no or one root in the interval, nothing else is computed.
std::vector<RealRoot> real_roots(const Polynomial& polynomial, const mpq_class& lo,
                                 const mpq_class& hi);

/// Every gap has the form E = a − √b − √c with b, c >= 0. E is zero only where its norm N is, the
/// product of E over all signs of the two roots:
///
///   N = (a² − b − c)² − 4bc,   or a² − b if c is identically zero.
///
/// Conversely E is zero where N is and no other factor is.

/// Is E exactly zero?
bool is_root_sum(const mpz_class& a, const mpz_class& b, const mpz_class& c);

/// N for polynomials a, b, c.
Polynomial root_sum_norm(const Polynomial& a, const Polynomial& b, const Polynomial& c);

/// Are all factors of N other than E certainly not zero? Precondition: c is exactly zero or its
/// ball excludes zero.
bool has_no_other_zero(const Ball& a, const Ball& b, const Ball& c);

}  // namespace touchstone::oracle
