#include "oracle/real_roots.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace touchstone::oracle {

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial sum(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) sum[i] += b[i];
  return sum;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + mpz_class(-1) * b; }

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}

Polynomial operator*(const mpz_class& a, const Polynomial& b) {
  Polynomial product = b;
  for (auto& c : product) c *= a;
  return product;
}

Ball value_at(const Polynomial& p, const Ball& x) {
  Ball value(0);
  for (std::size_t i = p.size(); i-- > 0;) value = value * x + Ball(p[i]);
  return value;
}

bool is_zero(const Polynomial& p) {
  return std::all_of(p.begin(), p.end(), [](const mpz_class& c) { return c == 0; });
}

RealRoot::RealRoot(Polynomial polynomial, mpq_class lo, mpq_class hi)
    : polynomial_(std::move(polynomial)),
      derivative_(derivative(polynomial_)),
      lo_(std::move(lo)),
      hi_(std::move(hi)),
      sign_at_lo_(0) {
  // An end of the interval may itself be the root.
  if (sign_at(polynomial_, lo_) == 0) hi_ = lo_;
  if (sign_at(polynomial_, hi_) == 0) lo_ = hi_;
  sign_at_lo_ = sign_at(polynomial_, lo_);
  assert(lo_ == hi_ || sign_at_lo_ * sign_at(polynomial_, hi_) < 0);
}

bool RealRoot::is(const mpq_class& number) const {
  return lo_ <= number && number <= hi_ && sign_at(polynomial_, number) == 0;
}

void RealRoot::bisect() {
  const mpq_class middle = (lo_ + hi_) / 2;
  const int sign = sign_at(polynomial_, middle);
  if (sign == 0) {
    lo_ = hi_ = middle;
  } else if (sign == sign_at_lo_) {
    lo_ = middle;
  } else {
    hi_ = middle;
  }
}

bool RealRoot::newton_step(long bits) {
  const WorkingPrecision precision(bits);
  const mpq_class width = hi_ - lo_;
  const Ball slope = value_at(derivative_, Ball(lo_, hi_));
  if (slope.contains_zero()) return false;
  const mpq_class middle = on_grid((lo_ + hi_) / 2, bits, false);
  if (middle < lo_) return false;
  const Ball next = Ball(middle) - value_at(polynomial_, Ball(middle)) / slope;
  if (!next.is_finite()) return false;
  const mpq_class lo = std::max(lo_, on_grid(next.lower(), bits, false));
  const mpq_class hi = std::min(hi_, on_grid(next.upper(), bits, true));
  // Both intervals contain the root, so they intersect.
  assert(lo <= hi);
  lo_ = lo;
  hi_ = hi;
  if (lo_ != hi_) {
    if (sign_at(polynomial_, lo_) == 0) hi_ = lo_;
    if (sign_at(polynomial_, hi_) == 0) lo_ = hi_;
  }
  return 2 * (hi_ - lo_) <= width;
}

Ball RealRoot::enclose() {
  const long bits = WorkingPrecision::bits();
  const auto narrow_enough = [&] {
    const mpq_class size = std::max(mpq_class(1), mpq_class(abs(lo_)));
    return (hi_ - lo_) * mpq_class(mpz_class(1) << static_cast<mp_bitcnt_t>(bits)) <= size;
  };
  long newton_bits = bits + 32;
  while (!narrow_enough()) {
    if (!newton_step(newton_bits)) {
      bisect();
      newton_bits += 8;  // close roots cancel digits: try again with a few more
    }
  }
  // Extra bits so that the ends are represented exactly enough.
  const WorkingPrecision precision(bits + 16);
  return Ball(lo_, hi_);
}

bool RealRoot::is_root_of(const Polynomial& other) const {
  if (is_zero(other)) return true;
  if (lo_ == hi_) return sign_at(other, lo_) == 0;
  // The common factor has at most this root in the interval, and it is simple.
  const Polynomial common = common_divisor(polynomial_, other);
  return sign_at(common, lo_) * sign_at(common, hi_) < 0;
}

std::vector<RealRoot> real_roots(const Polynomial& polynomial, const mpq_class& lo,
                                 const mpq_class& hi) {
  std::vector<RealRoot> result;
  if (sign_at(polynomial, lo) != 0 && sign_at(polynomial, hi) != 0) {
    const int variations = sign_variations(polynomial, lo, hi);
    if (variations == 0) return result;
    if (variations == 1) {
      result.emplace_back(polynomial, lo, hi);
      return result;
    }
  }
  Polynomial rest = square_free(polynomial);
  const auto take_end = [&](const mpq_class& end) {
    if (sign_at(rest, end) != 0) return;
    result.emplace_back(rest, end, end);
    rest = without_root(rest, end);
  };
  take_end(lo);
  take_end(hi);
  for (const RootInterval& root : isolate_roots(rest, lo, hi)) {
    result.emplace_back(rest, root.lo, root.hi);
  }
  return result;
}

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
