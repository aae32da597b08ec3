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

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t i = 1; i < p.size(); ++i) {
    result.push_back(p[i] * static_cast<unsigned long>(i));
  }
  return result;
}

/// Upper bound of the number of roots between lo and hi, ends excluded, with multiplicities; of the
/// same parity: Descartes' rule of signs on (1 + x)^k p((lo + hi x)/(1 + x)). Collins and Akritas,
/// "Polynomial real root isolation using Descartes' rule of signs", SYMSAC 1976.
int sign_variations(const Polynomial& p, const mpq_class& lo, const mpq_class& hi) {
  // Over a common denominator m, Σ c_i (a + b x)^i (m + m x)^(k−i), by Horner's scheme.
  mpz_class m = lcm(lo.get_den(), hi.get_den());
  const Polynomial top{mpz_class(lo * m), mpz_class(hi * m)}, bottom{m, m};
  Polynomial value{0}, power{1};
  for (std::size_t i = p.size(); i-- > 0;) {
    value = value * top + p[i] * power;
    power = power * bottom;
  }
  int variations = 0, last = 0;
  for (const auto& c : value) {
    const int sign = sgn(c);
    if (sign == 0) continue;
    if (sign == -last) ++variations;
    last = sign;
  }
  return variations;
}

using Kernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;

/// The primitive part.
Kernel::Polynomial_1 to_kernel(const Polynomial& polynomial) {
  mpz_class content = 0;
  for (const auto& c : polynomial) content = gcd(content, c);
  std::vector<CGAL::Gmpz> coefficients;
  for (const auto& c : polynomial) {
    const mpz_class primitive = c / content;
    coefficients.emplace_back(primitive.get_mpz_t());
  }
  return {coefficients.begin(), coefficients.end()};
}

Polynomial from_kernel(const Kernel::Polynomial_1& polynomial) {
  Polynomial result;
  for (int i = 0; i <= polynomial.degree(); ++i) result.emplace_back(polynomial[i].mpz());
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

bool RealRoot::is_root_of(const Polynomial& other) const {
  if (is_zero(other)) return true;
  if (lo_ == hi_) return sign_at(other, lo_) == 0;
  // The common factor has at most this one root in the interval, a simple one.
  const Polynomial common = from_kernel(CGAL::gcd(to_kernel(polynomial_), to_kernel(other)));
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
  std::vector<Kernel::Algebraic_real_1> roots;
  Kernel().solve_1_object()(to_kernel(polynomial), false, std::back_inserter(roots));
  for (const auto& root : roots) {
    const mpq_class low(root.low().mpq()), high(root.high().mpq());
    if (high < lo || low > hi) continue;
    result.emplace_back(from_kernel(root.polynomial()), low, high);
  }
  return result;
}

}  // namespace touchstone::oracle
