#include "oracle/interval_difference.hpp"

#include <cmath>
#include <limits>

namespace touchstone::oracle {
namespace {

/// Mantissa and exponent of an integer.
struct Scaled {
  Interval mantissa;  // its magnitude within [1/2, 1], or zero
  long exponent;
};

Scaled scaled(const Integer& value) {
  Scaled result{0, 0};
  const double towards_zero = mpz_get_d_2exp(&result.exponent, value.get_mpz_t());
  if (towards_zero == 0) return result;
  const double away = std::nextafter(towards_zero, towards_zero > 0 ? 1 : -1);
  result.mantissa = mpz_sizeinbase(value.get_mpz_t(), 2) <= 53 ? Interval(towards_zero)
                    : towards_zero > 0                         ? Interval(towards_zero, away)
                                                               : Interval(away, towards_zero);
  return result;
}

Interval ratio(const Integer& numerator, const Scaled& denominator) {
  const Scaled top = scaled(numerator);
  const Interval mantissas = top.mantissa / denominator.mantissa;
  const long exponent = top.exponent - denominator.exponent;
  // Far from the ends of the exponents' range, where a power of two would round or overflow.
  constexpr long limit = 900;
  if (exponent < -limit) {
    const double tiny = std::ldexp(1, -static_cast<int>(limit));
    return {-tiny, tiny};
  }
  if (exponent > limit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {-infinity, infinity};
  }
  return mantissas * Interval(std::ldexp(1, static_cast<int>(exponent)));
}

IntervalVector ratio(const IntegerVector& v, const Scaled& denominator) {
  return {ratio(v.x, denominator), ratio(v.y, denominator), ratio(v.z, denominator)};
}

IntervalDifference::IntervalFrame unit(const Frame& frame, const Scaled& norm) {
  return {ratio(frame.axis, norm), ratio(frame.e, norm), ratio(frame.f, norm)};
}

}  // namespace

IntervalDifference::IntervalDifference(const Difference& difference) : scale(difference.inflation) {
  for (const auto& s : difference.segments) scale += s.half_length;
  for (const auto& disc : difference.discs) scale += disc.radius;
  const Scaled norm = scaled(difference.norm);
  const Scaled length = scaled(scale);

  d = ratio(difference.d, scaled(scale * difference.norm));
  for (const auto& s : difference.segments) {
    segments.push_back({unit(s.frame, norm), ratio(s.half_length, length)});
  }
  for (const auto& disc : difference.discs) {
    discs.push_back({unit(disc.frame, norm), ratio(disc.radius, length)});
  }
  inflation = ratio(difference.inflation, length);
}

Interval IntervalDifference::gap(const IntervalVector& n) const {
  Interval value = dot(d, n);
  for (const auto& s : segments) value -= s.half_length * abs(dot(s.frame.axis, n));
  for (const auto& disc : discs) {
    value -= disc.radius * sqrt(square(dot(disc.frame.e, n)) + square(dot(disc.frame.f, n)));
  }
  return value / sqrt(square(n.x) + square(n.y) + square(n.z)) - inflation;
}

}  // namespace touchstone::oracle
