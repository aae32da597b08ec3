#pragma once

#include <gmpxx.h>
#include <vector>

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

}  // namespace touchstone::oracle
