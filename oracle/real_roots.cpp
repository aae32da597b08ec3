#include "oracle/real_roots.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

namespace touchstone::oracle {
namespace {

int sign(const Ball& x) { return x.is_positive() ? 1 : x.is_negative() ? -1 : 0; }

Ball exact_ball(const Float& x) {
  Ball result;
  arb_set_arf(result.get(), x.get());
  return result;
}

long length_in_bits(const mpq_class& x) { return bits_of(x.get_num()) + bits_of(x.get_den()); }

class InBalls : public BallFunction {
 public:
  InBalls(const Polynomial& polynomial, const Polynomial& derivative)
      : polynomial_(polynomial), derivative_(derivative) {}
  Ball value(const Ball& t) const override { return value_at(polynomial_, t); }
  Ball change(const Ball& t) const override { return value_at(derivative_, t); }

 private:
  const Polynomial &polynomial_, &derivative_;
};

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

Ball RootBracket::ball() const {
  Ball result;
  arb_set_interval_arf(result.get(), lo_.get(), hi_.get(), WorkingPrecision::bits());
  return result;
}

bool RootBracket::is_narrow(long bits) const {
  return arf_cmp_2exp_si((hi_ - lo_).get(), -bits) <= 0;
}

double RootBracket::width_bits() const {
  mag_t width;
  mag_init(width);
  arf_get_mag(width, (hi_ - lo_).get());
  const double bits = 1 - mag_get_d_log2_approx(width);
  mag_clear(width);
  return bits;
}

void RootBracket::narrow_here(const BallFunction& function, long wanted_bits) {
  while (!is_narrow(wanted_bits) && (newton(function, wanted_bits) || trisect(function))) {
  }
}

/// The function's change anywhere in the interval, whose width limits how well it can be known:
/// more digits than that would be in vain.
Ball RootBracket::change(const BallFunction& function) const {
  constexpr long guard_bits = 16, min_bits = 64;
  const long enough = std::max(min_bits, static_cast<long>(width_bits()) + guard_bits);
  const Ball t = ball();
  if (enough < WorkingPrecision::bits()) {
    const WorkingPrecision precision(enough);
    Ball result = function.change(t);
    if (!result.contains_zero()) return result;
  }
  return function.change(t);
}

/// Interval Newton, once more with the same change if that is enough. False if it does not halve
/// the interval.
bool RootBracket::newton(const BallFunction& function, long wanted_bits) {
  const Ball wide_change = change(function);
  if (wide_change.contains_zero()) return false;
  bool halved = false;
  for (;;) {
    const double before = width_bits();
    if (!newton_step(function, wide_change)) return halved;
    halved = true;
    if (is_narrow(wanted_bits)) return true;
    const double after = width_bits(), gain = after - before;
    if (after + gain < static_cast<double>(wanted_bits + 1)) return true;
  }
}

/// `change` holds for the interval or a wider one. False if the interval is not halved.
bool RootBracket::newton_step(const BallFunction& function, const Ball& change) {
  const Float half(0.5);
  const Ball middle = exact_ball(half * (lo_ + hi_));
  const Ball next = middle - function.value(middle) / change;
  if (!next.is_finite()) return false;
  const Float lo = std::max(lo_, next.lower_end()), hi = std::min(hi_, next.upper_end());
  // Both contain the root.
  if (hi < lo) throw std::logic_error("oracle: a root is lost");
  const bool halved = !(half * (hi_ - lo_) < hi - lo);
  if (halved) *this = {lo, hi, rising_};
  return halved;
}

/// Cuts off what the function's signs at two points inside say: the root may be one of them, but
/// not both. False if neither sign is certain at this precision.
bool RootBracket::trisect(const BallFunction& function) {
  const Float width = hi_ - lo_;
  const Float points[] = {lo_ + Float(0.375) * width, lo_ + Float(0.625) * width};
  const int sign_at_lo = rising_ ? -1 : 1;
  bool moved = false;
  for (const Float& at : points) {
    const int here = sign(function.value(exact_ball(at)));
    if (here == 0) continue;
    moved = true;
    // With the root below the lower point, the upper one only confirms it.
    if (here == sign_at_lo) {
      lo_ = at;
    } else if (at < hi_) {
      hi_ = at;
    }
  }
  return moved;
}

RealRoot::RealRoot(Polynomial polynomial, mpq_class lo, mpq_class hi)
    : polynomial_(std::move(polynomial)),
      derivative_(derivative(polynomial_)),
      lo_(std::move(lo)),
      hi_(std::move(hi)) {
  // An end of the interval may itself be the root.
  if (sign_at(polynomial_, lo_) == 0) hi_ = lo_;
  if (sign_at(polynomial_, hi_) == 0) lo_ = hi_;
  if (lo_ == hi_) return;
  const bool rising = sign_at(polynomial_, lo_) < 0;
  assert(sign_at(polynomial_, hi_) == (rising ? 1 : -1));
  // So that the ends, if they are dyadic as all that isolation finds, are exact.
  constexpr long guard_bits = 64;
  const WorkingPrecision precision(guard_bits + length_in_bits(lo_) + length_in_bits(hi_));
  bracket_.emplace(Ball(lo_).lower_end(), Ball(hi_).upper_end(), rising);
}

bool RealRoot::is(const mpq_class& number) const {
  return lo_ <= number && number <= hi_ && sign_at(polynomial_, number) == 0;
}

Ball RealRoot::enclose() {
  if (!bracket_) return Ball(lo_);
  const long bits = WorkingPrecision::bits();
  bracket_->narrow(bits, [&] { return InBalls(polynomial_, derivative_); });
  // Extra bits so that the ends are represented exactly enough.
  const WorkingPrecision precision(bits + 16);
  return bracket_->ball();
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
