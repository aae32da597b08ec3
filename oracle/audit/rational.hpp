#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <string>

#include "oracle/audit/certain_bounds.hpp"
#include "oracle/audit/certificate.hpp"

namespace touchstone::audit {

/// Exact arithmetic for what a certificate claims.
using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational,
                                               boost::multiprecision::et_off>;

/// x as a multiple of 2^−bits: towards zero, down or up.
Rational rounded(const Multiprecision& x, int bits, mpfr_rnd_t direction);

/// Every shape but the half-space keeps a point whose local coordinates move towards zero.
Vector<Rational> truncated(const Vector<Multiprecision>& v, int bits);
PointPair<Rational> truncated(const PointPair<Multiprecision>& pair, int bits);

/// Bits after the binary point that resolve a small positive length.
int bits_of(const Multiprecision& length);

/// product <= bound · root(square), without a root.
bool at_most(const Rational& product, const Rational& bound, const Rational& square);

DirectionCell<Rational> exact_cell(const DirectionCell<Multiprecision>& cell);
/// As Certificate::Cell::path.
std::string path_of(const DirectionCell<Multiprecision>& cell);

mpq_class in_metres(const Rational& units, double unit);
RationalVector in_metres(const Vector<Rational>& v, double unit);
RationalPair in_metres(const PointPair<Rational>& pair, double unit);

}  // namespace touchstone::audit
