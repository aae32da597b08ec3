#include "oracle/grid_cell.hpp"

namespace touchstone::oracle {
namespace {

/// Over a prime, 2^61 − 1: a number on the border of two cells has it in its denominator. Far from
/// 0, 1/2 and 1, where numbers of few digits lie.
const mpq_class shift(mpz_class("880753656798294016"), (mpz_class(1) << 61U) - 1);

mpz_class floor(const mpq_class& x) {
  mpz_class result;
  mpz_fdiv_q(result.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
  return result;
}

/// The largest power of two not above x > 0.
mpq_class power_of_two_below(const mpq_class& x) {
  const auto bits = [](const mpz_class& z) {
    return static_cast<long>(mpz_sizeinbase(z.get_mpz_t(), 2));
  };
  const long exponent = bits(x.get_num()) - bits(x.get_den());
  mpq_class power = 1;
  if (exponent >= 0) {
    power <<= static_cast<mp_bitcnt_t>(exponent);
  } else {
    power >>= static_cast<mp_bitcnt_t>(-exponent);
  }
  return power <= x ? power : mpq_class(power / 2);
}

}  // namespace

GridCell::GridCell(double size, double width)
    : size_(size), spacing_(power_of_two_below(mpq_class(width) * mpq_class(size))) {}

std::optional<Enclosure> GridCell::around(const mpq_class& lo, const mpq_class& hi) const {
  if (lo <= 0 && 0 <= hi) return std::nullopt;
  for (mpq_class spacing = spacing_;; spacing /= 2) {
    const mpz_class cell = floor(lo / spacing - shift);
    if (floor(hi / spacing - shift) != cell) return std::nullopt;
    if (cell == -1) continue;
    const mpq_class start = (cell + shift) * spacing;
    return Enclosure{start, start + spacing};
  }
}

Enclosure GridCell::nearly_zero(long bits) const {
  const mpq_class end = power_of_two_below(size_) >> static_cast<mp_bitcnt_t>(bits);
  return {-end, end};
}

}  // namespace touchstone::oracle
