#pragma once

#include "oracle/ball.hpp"
#include "oracle/real_roots.hpp"

namespace touchstone::oracle {

/// E = a − √b − √c, the shape of every gap, where b and c are known not to be negative. E is zero
/// only where its norm, the product of E over all signs of the roots, is:
///
///   N = (a² − b − c)² − 4bc,   or a² − b where c is zero throughout;
///
/// and where N is zero and none of the other factors, E is.

/// Is E exactly zero?
bool is_root_sum(const mpz_class& a, const mpz_class& b, const mpz_class& c);

/// N over polynomials.
Polynomial root_sum_norm(const Polynomial& a, const Polynomial& b, const Polynomial& c);

/// Are all factors of N other than E itself certainly not zero? c is exactly zero or not at all.
bool has_no_other_zero(const Ball& a, const Ball& b, const Ball& c);

}  // namespace touchstone::oracle
