#include "oracle/far_bodies.hpp"

#include <algorithm>
#include <utility>

namespace touchstone::oracle {
namespace {

long bits_of(const Integer& x) { return static_cast<long>(mpz_sizeinbase(x.get_mpz_t(), 2)); }

Integer sum_of_sizes(const Difference& difference) {
  Integer sum = difference.inflation;
  for (const auto& s : difference.segments) sum += s.half_length;
  for (const auto& disc : difference.discs) sum += disc.radius;
  return sum;
}

/// Towards zero.
Integer shifted(const Integer& x, long bits) {
  Integer result;
  mpz_tdiv_q_2exp(result.get_mpz_t(), x.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
  return result;
}

}  // namespace

std::optional<FarBodies> FarBodies::brought_nearer(Difference& difference, int bits) {
  if (difference.is_plane || difference.segments.size() == 1) return std::nullopt;
  const Integer size = sum_of_sizes(difference);
  const IntegerVector& d = difference.d;
  const long excess = std::max({bits_of(d.x), bits_of(d.y), bits_of(d.z)}) -
                      bits_of(size * difference.norm) - bits - 1;
  if (excess <= 0) return std::nullopt;
  const Difference before = difference;
  difference.d = {shifted(d.x, excess), shifted(d.y, excess), shifted(d.z, excess)};
  // The centres are now at least 2^bits S apart: the two upper bounds exceed the lower ones by less
  // than S 2^-bits, and the direction, truncated by less than √3 of D norm, is off by 4 2^-bits/S.
  mpq_class error(5 * size);
  error >>= static_cast<mp_bitcnt_t>(bits);
  return FarBodies(before, difference, std::move(error));
}

FarBodies::FarBodies(const Difference& before, const Difference& after, mpq_class error)
    : before_(before.d), after_(after.d), norm_(before.norm), error_(std::move(error)) {}

Ball FarBodies::shift() const {
  return (norm(to_balls(before_)) - norm(to_balls(after_))) / Ball(norm_);
}

}  // namespace touchstone::oracle
