#include "oracle/audit/rational.hpp"

#include <algorithm>

namespace touchstone::audit {

Rational rounded(const Multiprecision& x, int bits, mpfr_rnd_t direction) {
  const Multiprecision scaled = ldexp(x, bits);
  mpq_class q;
  mpfr_get_z(q.get_num_mpz_t(), scaled.backend().data(), direction);
  q /= mpz_class(1) << static_cast<mp_bitcnt_t>(bits);
  return Rational(q.get_mpq_t());
}

Vector<Rational> truncated(const Vector<Multiprecision>& v, int bits) {
  return {rounded(v.x(), bits, MPFR_RNDZ), rounded(v.y(), bits, MPFR_RNDZ),
          rounded(v.z(), bits, MPFR_RNDZ)};
}

PointPair<Rational> truncated(const PointPair<Multiprecision>& pair, int bits) {
  return {truncated(pair.a, bits), truncated(pair.b, bits)};
}

int bits_of(const Multiprecision& length) {
  return std::max(0, 2 - static_cast<int>(ilogb(length)));
}

bool at_most(const Rational& product, const Rational& bound, const Rational& square) {
  const Rational p = product * product, b = bound * bound * square;
  return bound < 0 ? product <= 0 && p >= b : product <= 0 || p <= b;
}

DirectionCell<Rational> exact_cell(const DirectionCell<Multiprecision>& cell) {
  const auto exact = [&](const Multiprecision& x) { return rounded(x, cell.level, MPFR_RNDZ); };
  return {cell.face, cell.level, exact(cell.u), exact(cell.v), exact(cell.size)};
}

std::string path_of(const DirectionCell<Multiprecision>& cell) {
  std::string path = std::to_string(cell.face);
  auto at = DirectionCell<Multiprecision>::whole_face(cell.face);
  for (int level = 0; level < cell.level; ++level) {
    const Multiprecision half = at.size / 2;
    const int quarter = (cell.u >= at.u + half ? 1 : 0) + (cell.v >= at.v + half ? 2 : 0);
    path += static_cast<char>('0' + quarter);
    at = at.child(quarter);
  }
  return path;
}

mpq_class in_metres(const Rational& units, double unit) {
  return mpq_class(units.backend().data()) * mpq_class(unit);
}
RationalVector in_metres(const Vector<Rational>& v, double unit) {
  return {in_metres(v.x(), unit), in_metres(v.y(), unit), in_metres(v.z(), unit)};
}
RationalPair in_metres(const PointPair<Rational>& pair, double unit) {
  return {in_metres(pair.a, unit), in_metres(pair.b, unit)};
}

}  // namespace touchstone::audit
