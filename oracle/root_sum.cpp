#include "oracle/root_sum.hpp"

namespace touchstone::oracle {

bool is_root_sum(const mpz_class& a, const mpz_class& b, const mpz_class& c) {
  if (a < 0) return false;
  const mpz_class rest = a * a - b - c;  // 2 √(bc)
  return rest >= 0 && rest * rest == 4 * b * c;
}

Polynomial root_sum_norm(const Polynomial& a, const Polynomial& b, const Polynomial& c) {
  if (is_zero(c)) return a * a - b;
  const Polynomial rest = a * a - b - c;
  return rest * rest - mpz_class(4) * (b * c);
}

bool has_no_other_zero(const Ball& a, const Ball& b, const Ball& c) {
  const Ball root_b = sqrt(b);
  if (c.is_zero()) return !(a + root_b).contains_zero();
  const Ball root_c = sqrt(c);
  return !(a + root_b + root_c).contains_zero() && !(a + root_b - root_c).contains_zero() &&
         !(a - root_b + root_c).contains_zero();
}

}  // namespace touchstone::oracle
