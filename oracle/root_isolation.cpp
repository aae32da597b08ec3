#include <algorithm>
#include <flint/fmpz_poly.h>
#include <utility>

#include "oracle/ball.hpp"
#include "oracle/real_roots.hpp"

namespace touchstone::oracle {
namespace {

/// Owner of a FLINT polynomial.
struct FlintPolynomial {
  FlintPolynomial() { fmpz_poly_init(value); }
  explicit FlintPolynomial(const Polynomial& p) : FlintPolynomial() {
    for (std::size_t i = 0; i < p.size(); ++i) {
      fmpz_poly_set_coeff_mpz(value, static_cast<slong>(i), p[i].get_mpz_t());
    }
  }
  ~FlintPolynomial() { fmpz_poly_clear(value); }
  FlintPolynomial(const FlintPolynomial&) = delete;
  FlintPolynomial& operator=(const FlintPolynomial&) = delete;

  Polynomial coefficients() const {
    Polynomial result(static_cast<std::size_t>(fmpz_poly_length(value)));
    for (std::size_t i = 0; i < result.size(); ++i) {
      fmpz_poly_get_coeff_mpz(result[i].get_mpz_t(), value, static_cast<slong>(i));
    }
    return result;
  }
  fmpz_poly_t value;
};

long coefficient_bits(const Polynomial& p) {
  long bits = 0;
  for (const auto& c : p) bits = std::max(bits, bits_of(c));
  return bits;
}

// Signs of polynomial expressions in long integers: first in balls of few bits, which usually
// suffice, then exactly. The formulas are templates over both rings.

template <class Number>
Number number(const mpz_class& x);
template <>
mpz_class number<mpz_class>(const mpz_class& x) {
  return x;
}
/// Rounded to the working precision.
template <>
Ball number<Ball>(const mpz_class& x) {
  return Ball(x, WorkingPrecision::bits());
}

/// p(x) m^k for the denominator m of x and the degree k: Horner's scheme without a gcd.
template <class Number>
Number value_at(const Polynomial& p, const mpq_class& x) {
  const Number n = number<Number>(x.get_num()), m = number<Number>(x.get_den());
  Number value = 0, power = 1;
  for (std::size_t i = p.size(); i-- > 0;) {
    value = value * n + number<Number>(p[i]) * power;
    power = power * m;
  }
  return value;
}

/// Coefficients of (1 + x)^k p((lo + hi x)/(1 + x)) up to a positive factor: with lo = a/m and
/// hi = b/m, Σ c_i (a + b x)^i (m + m x)^(k−i) by Horner's scheme.
template <class Number>
std::vector<Number> over_interval(const Polynomial& p, const mpq_class& lo, const mpq_class& hi) {
  const mpz_class denominator = lcm(lo.get_den(), hi.get_den());
  const Number m = number<Number>(denominator);
  const Number a = number<Number>(lo.get_num() * (denominator / lo.get_den()));
  const Number b = number<Number>(hi.get_num() * (denominator / hi.get_den()));
  std::vector<Number> value;
  std::vector<int> binomial{1};
  Number power = 1;
  for (std::size_t i = p.size(); i-- > 0;) {
    value.emplace_back(0);
    for (std::size_t k = value.size(); k-- > 1;) value[k] = a * value[k] + b * value[k - 1];
    value[0] = a * value[0];
    const Number scaled = number<Number>(p[i]) * power;
    for (std::size_t k = 0; k < binomial.size(); ++k) {
      value[k] = value[k] + scaled * Number(binomial[k]);
    }
    power = power * m;
    binomial.emplace_back(0);
    for (std::size_t k = binomial.size(); k-- > 1;) binomial[k] += binomial[k - 1];
  }
  return value;
}

template <class Number, class Sign>
int variations(const std::vector<Number>& coefficients, const Sign& sign_of) {
  int result = 0, last = 0;
  for (const auto& c : coefficients) {
    const int sign = sign_of(c);
    if (sign == 0) continue;
    if (sign == -last) ++result;
    last = sign;
  }
  return result;
}

bool has_sign(const Ball& x) { return !x.contains_zero(); }
int sign_of(const Ball& x) { return x.is_positive() ? 1 : -1; }

/// Calls ask() at rising precisions until it succeeds. Gives up (false) once balls would be as long
/// as the exact numbers, which have `exact_bits`.
template <class Ask>
bool decided_by_balls(long exact_bits, const Ask& ask) {
  constexpr long first_bits = 192, growth = 2;
  for (long bits = first_bits; growth * bits < exact_bits; bits *= growth) {
    const WorkingPrecision precision(bits);
    if (ask()) return true;
  }
  return false;
}

/// Length in bits of the exact p(x) m^k.
long bits_of_value(const Polynomial& p, long denominator_bits) {
  return coefficient_bits(p) + static_cast<long>(p.size()) * denominator_bits;
}

/// Upper bound of −log2(x) for x > 0.
long bits_below_one(const mpq_class& x) {
  return static_cast<long>(mpz_sizeinbase(x.get_den_mpz_t(), 2)) -
         static_cast<long>(mpz_sizeinbase(x.get_num_mpz_t(), 2)) + 1;
}

/// An interval whose ends are not roots.
struct Piece {
  mpq_class lo, hi;
  int variations;
  long speed;  ///< the next jump shrinks the width by 2^-speed
};

constexpr long first_speed = 2;

class Isolation {
 public:
  explicit Isolation(const Polynomial& p) : p_(p), slope_(derivative(p)) {}

  std::vector<RootInterval> run(const mpq_class& lo, const mpq_class& hi) {
    std::vector<Piece> open{{lo, hi, sign_variations(p_, lo, hi), first_speed}};
    std::vector<RootInterval> found;
    while (!open.empty()) {
      Piece piece = std::move(open.back());
      open.pop_back();
      if (piece.variations == 0) continue;
      if (piece.variations == 1) {
        found.push_back({piece.lo, piece.hi});
      } else if (jump(piece)) {
        open.push_back(std::move(piece));
      } else {
        split(piece, open);
      }
    }
    return found;
  }

 private:
  /// Shrinks the piece to the neighbourhood in which Newton's method predicts all of its roots.
  /// False if some are elsewhere.
  bool jump(Piece& piece) const {
    const mpq_class width = piece.hi - piece.lo;
    mpq_class half = width;
    half >>= static_cast<mp_bitcnt_t>(piece.speed + 1);
    const long grid_bits = std::max(0L, bits_below_one(half) + 2);
    for (const mpq_class& from : {mpq_class((piece.lo + piece.hi) / 2), piece.lo, piece.hi}) {
      const mpq_class centre = on_grid(newton(from, piece.variations), grid_bits, false);
      if (centre < piece.lo || centre > piece.hi) continue;
      const mpq_class lo = std::max(piece.lo, mpq_class(centre - half));
      const mpq_class hi = std::min(piece.hi, mpq_class(centre + half));
      if (sign_at(p_, lo) == 0 || sign_at(p_, hi) == 0) continue;
      // The sign variations of disjoint parts add up to at most those of the whole, so that none
      // are left for the rest.
      if (sign_variations(p_, lo, hi) != piece.variations) continue;
      piece.lo = lo;
      piece.hi = hi;
      piece.speed *= 2;
      return true;
    }
    return false;
  }

  /// One step of Newton's method for a root of that multiplicity; x itself if the slope is zero.
  mpq_class newton(const mpq_class& x, int multiplicity) const {
    mpq_class step = 0;
    const bool decided = decided_by_balls(bits_of_value(p_, bits_of(x.get_den())), [&] {
      const Ball value = value_at<Ball>(p_, x), slope = value_at<Ball>(slope_, x);
      if (!has_sign(value) || !has_sign(slope)) return false;
      const Ball ratio = value / (slope * Ball(x.get_den()));
      step = multiplicity * ratio.lower();
      return true;
    });
    if (decided) return x - step;
    const auto slope = value_at<mpz_class>(slope_, x);
    if (slope == 0) return x;
    step = mpq_class(multiplicity * value_at<mpz_class>(p_, x), slope * x.get_den());
    step.canonicalize();
    return x - step;
  }

  void split(const Piece& piece, std::vector<Piece>& open) const {
    const long speed = std::max(first_speed, piece.speed / 2);
    const mpq_class middle = between(piece);
    open.push_back({middle, piece.hi, sign_variations(p_, middle, piece.hi), speed});
    open.push_back({piece.lo, middle, sign_variations(p_, piece.lo, middle), speed});
  }

  /// A point near the middle that is not a root.
  mpq_class between(const Piece& piece) const {
    mpq_class offset = (piece.hi - piece.lo) / 2;
    mpq_class middle = piece.lo + offset;
    while (sign_at(p_, middle) == 0) {
      offset /= 4;
      middle += offset;
    }
    return middle;
  }

  const Polynomial& p_;
  Polynomial slope_;
};

}  // namespace

int sign_at(const Polynomial& p, const mpq_class& x) {
  int sign = 0;
  const bool decided = decided_by_balls(bits_of_value(p, bits_of(x.get_den())), [&] {
    const Ball value = value_at<Ball>(p, x);
    if (!has_sign(value)) return false;
    sign = sign_of(value);
    return true;
  });
  return decided ? sign : sgn(value_at<mpz_class>(p, x));
}

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

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t i = 1; i < p.size(); ++i) {
    result.push_back(p[i] * static_cast<unsigned long>(i));
  }
  return result;
}

Polynomial common_divisor(const Polynomial& p, const Polynomial& q) {
  const FlintPolynomial first(p), second(q);
  FlintPolynomial result;
  fmpz_poly_gcd(result.value, first.value, second.value);
  fmpz_poly_primitive_part(result.value, result.value);
  return result.coefficients();
}

Polynomial square_free(const Polynomial& p) {
  FlintPolynomial whole(p), slope, multiple;
  fmpz_poly_primitive_part(whole.value, whole.value);
  fmpz_poly_derivative(slope.value, whole.value);
  fmpz_poly_gcd(multiple.value, whole.value, slope.value);
  if (fmpz_poly_degree(multiple.value) > 0) {
    fmpz_poly_primitive_part(multiple.value, multiple.value);
    fmpz_poly_div(whole.value, whole.value, multiple.value);
  }
  return whole.coefficients();
}

Polynomial without_root(const Polynomial& p, const mpq_class& root) {
  const FlintPolynomial whole(p), factor({mpz_class(-root.get_num()), root.get_den()});
  FlintPolynomial rest;
  fmpz_poly_div(rest.value, whole.value, factor.value);
  return rest.coefficients();
}

int sign_variations(const Polynomial& p, const mpq_class& lo, const mpq_class& hi) {
  int result = 0;
  const long denominator_bits = std::max(bits_of(lo.get_den()), bits_of(hi.get_den()));
  const bool decided = decided_by_balls(bits_of_value(p, denominator_bits), [&] {
    const auto coefficients = over_interval<Ball>(p, lo, hi);
    if (!std::all_of(coefficients.begin(), coefficients.end(), has_sign)) return false;
    result = variations(coefficients, sign_of);
    return true;
  });
  if (decided) return result;
  return variations(over_interval<mpz_class>(p, lo, hi), [](const mpz_class& c) { return sgn(c); });
}

std::vector<RootInterval> isolate_roots(const Polynomial& p, const mpq_class& lo,
                                        const mpq_class& hi) {
  return Isolation(p).run(lo, hi);
}

}  // namespace touchstone::oracle
