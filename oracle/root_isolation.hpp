#pragma once

#include <gmpxx.h>
#include <vector>

namespace touchstone::oracle {

/// Integer coefficients, constant term first.
using Polynomial = std::vector<mpz_class>;

/// Sign of p(x).
int sign_at(const Polynomial& p, const mpq_class& x);

/// Cuts a number to the dyadic grid of spacing 2^-bits: down, or up.
mpq_class on_grid(const mpq_class& x, long bits, bool up);

Polynomial derivative(const Polynomial& p);

/// Greatest common divisor of two polynomials that are not zero, and the polynomial that has each
/// root of p once: both primitive.
Polynomial common_divisor(const Polynomial& p, const Polynomial& q);
Polynomial square_free(const Polynomial& p);

/// A primitive polynomial divided by x − root.
Polynomial without_root(const Polynomial& p, const mpq_class& root);

/// Upper bound of the number of roots between lo and hi, ends excluded, with multiplicities; of the
/// same parity: Descartes' rule of signs on (1 + x)^k p((lo + hi x)/(1 + x)). Collins and Akritas,
/// "Polynomial real root isolation using Descartes' rule of signs", SYMSAC 1976.
int sign_variations(const Polynomial& p, const mpq_class& lo, const mpq_class& hi);

struct RootInterval {
  mpq_class lo, hi;  ///< the ends are no roots
};

/// Disjoint intervals in rising order that hold one root each: all those of a square-free
/// polynomial between lo and hi, which are no roots themselves.
///
/// Bisection would walk down to a cluster of roots 2^-k apart in k steps. Where Newton's method
/// with the cluster's multiplicity foretells its place, and Descartes' rule proves that no root is
/// elsewhere, the interval shrinks to that at once, and the more the oftener it succeeded: log k
/// steps. Sagraloff and Mehlhorn, "Computing real roots of real polynomials", J. Symbolic
/// Computation 73, 2016.
std::vector<RootInterval> isolate_roots(const Polynomial& p, const mpq_class& lo,
                                        const mpq_class& hi);

}  // namespace touchstone::oracle
