#pragma once

#include <gmpxx.h>
#include <string>

namespace touchstone::oracle {

/// A proven enclosure of a real number; both ends are exact rationals.
struct Enclosure {
  mpq_class lo, hi;

  double midpoint() const;  ///< The middle in double, towards zero.
  double width() const;     ///< hi − lo in double, towards zero.
};

/// A decimal that is not above (below) the exact value, with that many significant digits; trailing
/// zeros are left out.
std::string decimal_below(const mpq_class& value, int digits);
std::string decimal_above(const mpq_class& value, int digits);

}  // namespace touchstone::oracle
