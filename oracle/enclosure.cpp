#include "oracle/enclosure.hpp"

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

/// The denominator is the prime 2^61 − 1, so that every number on the border of two cells has it in
/// its own denominator. The fraction is far from 0, 1/2 and 1, near which numbers of few digits
/// lie.
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
