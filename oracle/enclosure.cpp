#include "oracle/enclosure.hpp"

#include <algorithm>
#include <cassert>

namespace touchstone::oracle {
namespace {

mpz_class power_of_ten(long exponent) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), 10, static_cast<unsigned long>(exponent));
  return result;
}

mpq_class times_power_of_ten(const mpq_class& value, long exponent) {
  return exponent >= 0 ? mpq_class(value * power_of_ten(exponent))
                       : mpq_class(value / power_of_ten(-exponent));
}

/// The e with 10^e <= |value| < 10^(e+1); value is not zero.
long decimal_exponent(const mpq_class& value) {
  const mpq_class magnitude = abs(value);
  long e = static_cast<long>(mpz_sizeinbase(magnitude.get_num_mpz_t(), 10)) -
           static_cast<long>(mpz_sizeinbase(magnitude.get_den_mpz_t(), 10));
  while (times_power_of_ten(1, e) > magnitude) --e;
  while (times_power_of_ten(1, e + 1) <= magnitude) ++e;
  return e;
}

std::string decimal(const mpq_class& value, int digits, bool up) {
  assert(digits > 0);
  if (value == 0) return "0";
  const long shift = digits - 1 - decimal_exponent(value);
  const mpq_class scaled = times_power_of_ten(value, shift);
  mpz_class integer;
  if (up) {
    mpz_cdiv_q(integer.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  } else {
    mpz_fdiv_q(integer.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  }
  std::string text = mpz_class(abs(integer)).get_str();
  // value = 0.text · 10^point
  const long point = static_cast<long>(text.size()) - shift;
  while (text.size() > 1 && text.back() == '0') text.pop_back();
  const long count = static_cast<long>(text.size());
  const std::string sign = sgn(integer) < 0 ? "-" : "";
  if (point > 17 || point < -4) {
    const std::string fraction = count > 1 ? "." + text.substr(1) : "";
    return sign + text[0] + fraction + "e" + std::to_string(point - 1);
  }
  if (point <= 0) return sign + "0." + std::string(static_cast<std::size_t>(-point), '0') + text;
  if (count <= point)
    return sign + text + std::string(static_cast<std::size_t>(point - count), '0');
  return sign + text.substr(0, static_cast<std::size_t>(point)) + "." +
         text.substr(static_cast<std::size_t>(point));
}

}  // namespace

double Enclosure::midpoint() const { return mpq_class((lo + hi) / 2).get_d(); }
double Enclosure::width() const { return mpq_class(hi - lo).get_d(); }

std::string decimal_below(const mpq_class& value, int digits) {
  return decimal(value, digits, false);
}
std::string decimal_above(const mpq_class& value, int digits) {
  return decimal(value, digits, true);
}

namespace {

/// The grid is shifted by this fraction of its spacing. The denominator is the prime 2^61 − 1, so
/// that every number on the border of two cells has it in its own denominator. The fraction is far
/// from 0, 1/2 and 1, near which numbers of few digits lie.
const mpz_class shift_numerator("880753656798294016");
const mpz_class shift_denominator = (mpz_class(1) << 61U) - 1;

mpq_class times_power_of_two(const mpq_class& x, long exponent) {
  return exponent >= 0 ? mpq_class(x << static_cast<mp_bitcnt_t>(exponent))
                       : mpq_class(x >> static_cast<mp_bitcnt_t>(-exponent));
}

/// The e with 2^e <= x < 2^(e+1), for x > 0.
long binary_exponent(const Float& x) { return arf_abs_bound_lt_2exp_si(x.get()) - 1; }

/// The largest integer not above a/b, for b > 0.
mpz_class floor_of_quotient(const Float& a, const Float& b) {
  // All digits before the binary point: rounding down to them does not pass an integer.
  const long digits = a.sign() == 0 ? 0 : binary_exponent(a) - binary_exponent(b) + 1;
  Float quotient;
  arf_div(quotient.get(), a.get(), b.get(), std::max(digits, 2L), ARF_RND_FLOOR);
  arf_floor(quotient.get(), quotient.get());
  return quotient.rational().get_num();
}

}  // namespace

GridCell::GridCell(double size, double width)
    : size_exponent_(binary_exponent(Float(size))),
      spacing_exponent_(binary_exponent(Float(width) * Float(size))) {}

std::optional<Enclosure> GridCell::around(const Float& lo, const Float& hi,
                                          const mpz_class& divisor) const {
  if (lo.sign() <= 0 && 0 <= hi.sign()) return std::nullopt;
  const Float parts(shift_denominator);  // of a cell
  for (long exponent = spacing_exponent_;; --exponent) {
    Float spacing(divisor);
    arf_mul_2exp_si(spacing.get(), spacing.get(), exponent);
    const Float part_of_shift = Float(shift_numerator) * spacing, cell_parts = parts * spacing;
    const auto cell_of = [&](const Float& x) {
      return floor_of_quotient(parts * x - part_of_shift, cell_parts);
    };
    const mpz_class cell = cell_of(lo);
    if (cell_of(hi) != cell) return std::nullopt;
    if (cell == -1) continue;
    const auto border = [&](const mpz_class& number) {
      return times_power_of_two(
          {mpz_class(number * shift_denominator + shift_numerator), shift_denominator}, exponent);
    };
    return Enclosure{border(cell), border(cell + 1)};
  }
}

Enclosure GridCell::nearly_zero(long bits) const {
  const mpq_class end = times_power_of_two(1, size_exponent_ - bits);
  return {-end, end};
}

}  // namespace touchstone::oracle
