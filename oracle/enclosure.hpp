#pragma once

#include <gmpxx.h>
#include <optional>
#include <string>

#include "oracle/ball.hpp"

namespace touchstone::oracle {

/// A proven enclosure of a real number; both ends are exact rationals.
struct Enclosure {
  mpq_class lo, hi;

  double midpoint() const;  ///< rounded to a double, towards zero
  double width() const;     ///< hi − lo, rounded to a double, towards zero
};

/// The value rounded down (up) to that many significant decimal digits, without trailing zeros.
std::string decimal_below(const mpq_class& value, int digits);
std::string decimal_above(const mpq_class& value, int digits);

/// Enclosures that depend on the enclosed number alone and not on how it was computed: the cells of
/// a grid whose spacing is a power of two. The grid is shifted by an unusual fraction of its
/// spacing, so that a number that arises from doubles is unlikely to lie on the border of two
/// cells.
class GridCell {
 public:
  /// The spacing is the largest power of two not above `width` times `size`, both > 0.
  GridCell(double size, double width);

  /// The cell that contains [lo, hi] / divisor, halved until it does not reach zero. None if that
  /// spans several cells or contains zero.
  std::optional<Enclosure> around(const Float& lo, const Float& hi, const mpz_class& divisor) const;

  /// ±2^-bits of the size.
  Enclosure nearly_zero(long bits) const;

 private:
  long size_exponent_, spacing_exponent_;  // of the powers of two not above
};

}  // namespace touchstone::oracle
