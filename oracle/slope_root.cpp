#include "oracle/slope_root.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

namespace touchstone::oracle {

bool CurveRoot::may_be(const Ball& root, const mpz_class& numerator, const mpz_class& denominator) {
  const long bits = WorkingPrecision::bits();
  return (root * Ball(denominator, bits) - Ball(numerator, bits)).contains_zero();
}

bool CurveRoot::take_only_root(const Polynomial& polynomial, const mpq_class& lo,
                               const mpq_class& hi) {
  if (lo == hi) {
    exact_.emplace(square_free(polynomial), lo, hi);
    return true;
  }
  std::vector<RealRoot> roots = real_roots(polynomial, lo, hi);
  if (roots.empty()) throw std::logic_error("oracle: a slope's root is none of the polynomial's");
  if (roots.size() > 1) return false;
  exact_ = std::move(roots.front());
  return true;
}

}  // namespace touchstone::oracle
