#include "oracle/real_roots.hpp"

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpz.h>
#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace touchstone::oracle {
namespace {

mpq_class value_at(const Polynomial& p, const mpq_class& x) {
  // Homogenised Horner: Σ c_i n^i m^(k−i) over m^k, without a gcd at every step.
  const mpz_class &n = x.get_num(), &m = x.get_den();
  mpz_class value = 0, power = 1;
  for (std::size_t i = p.size(); i-- > 0;) {
    value = value * n + p[i] * power;
    power *= m;
  }
  return mpq_class(value);  // times a positive power of the denominator: only its sign is used
}

int sign_at(const Polynomial& p, const mpq_class& x) { return sgn(value_at(p, x)); }

Ball value_at(const Polynomial& p, const Ball& x) {
  Ball value(0);
  for (std::size_t i = p.size(); i-- > 0;) value = value * x + Ball(p[i]);
  return value;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t i = 1; i < p.size(); ++i) {
    result.push_back(p[i] * static_cast<unsigned long>(i));
  }
  return result;
}

/// Cuts a number to the dyadic grid of spacing 2^-bits: down, or up.
mpq_class on_grid(const mpq_class& x, long bits, bool up) {
  const mpz_class numerator = x.get_num() << static_cast<mp_bitcnt_t>(bits);
  mpz_class quotient;
  if (up) {
    mpz_cdiv_q(quotient.get_mpz_t(), numerator.get_mpz_t(), x.get_den_mpz_t());
  } else {
    mpz_fdiv_q(quotient.get_mpz_t(), numerator.get_mpz_t(), x.get_den_mpz_t());
  }
  mpq_class result(quotient, mpz_class(1) << static_cast<mp_bitcnt_t>(bits));
  result.canonicalize();
  return result;
}

}  // namespace

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

bool is_zero(const Polynomial& p) {
  return std::all_of(p.begin(), p.end(), [](const mpz_class& c) { return c == 0; });
}

RealRoot::RealRoot(Polynomial square_free, mpq_class lo, mpq_class hi)
    : polynomial_(std::move(square_free)),
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
  // A root is in both intervals, so they meet.
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
      newton_bits += 8;  // close roots cancel digits; a stall is paid for with a few more
    }
  }
  // Room for the ends themselves.
  const WorkingPrecision precision(bits + 16);
  return Ball(lo_, hi_);
}

std::vector<RealRoot> real_roots(const Polynomial& polynomial) {
  using Kernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;
  mpz_class content = 0;
  for (const auto& c : polynomial) content = gcd(content, c);
  std::vector<CGAL::Gmpz> coefficients;
  for (const auto& c : polynomial) {
    const mpz_class primitive = c / content;
    coefficients.emplace_back(primitive.get_mpz_t());
  }
  const Kernel::Polynomial_1 p(coefficients.begin(), coefficients.end());

  std::vector<Kernel::Algebraic_real_1> roots;
  Kernel().solve_1_object()(p, false, std::back_inserter(roots));

  const auto rational = [](const auto& bound) { return mpq_class(bound.mpq()); };
  std::vector<RealRoot> result;
  result.reserve(roots.size());
  for (const auto& root : roots) {
    const auto& factor = root.polynomial();
    Polynomial square_free;
    for (int i = 0; i <= factor.degree(); ++i) square_free.emplace_back(factor[i].mpz());
    result.emplace_back(std::move(square_free), rational(root.low()), rational(root.high()));
  }
  return result;
}

}  // namespace touchstone::oracle
