#include "oracle/displacement.hpp"

namespace touchstone::oracle {
namespace {

/// Makes the unit finer by an integer factor.
void refine_unit(Difference& difference, const Integer& factor) {
  if (factor == 1) return;
  difference.per_metre *= factor;
  difference.d = factor * difference.d;
  for (auto& segment : difference.segments) segment.half_length *= factor;
  for (auto& disc : difference.discs) disc.radius *= factor;
  difference.inflation *= factor;
  if (!difference.hull) return;
  for (IntegerVector& v : difference.hull->vertices) v = factor * v;
  difference.hull->reach *= factor;
}

Integer least_common_multiple(const Integer& a, const Integer& b) {
  Integer result;
  mpz_lcm(result.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  return result;
}

}  // namespace

Vector3<mpq_class> in_units(const Difference& difference, const Vec3& metres) {
  const auto& rows = difference.world_rows;
  // They are exactly as long as the squared length of A's quaternion, by which they are divided.
  const Integer squared = dot(rows[0], rows[0]);
  Integer length;
  mpz_sqrt(length.get_mpz_t(), squared.get_mpz_t());
  mpq_class factor(difference.norm * difference.per_metre, length);
  factor.canonicalize();
  const mpq_class x(metres.x()), y(metres.y()), z(metres.z());
  const auto along = [&](Integer IntegerVector::*axis) {
    return mpq_class(factor * (x * rows[0].*axis + y * rows[1].*axis + z * rows[2].*axis));
  };
  return {along(&IntegerVector::x), along(&IntegerVector::y), along(&IntegerVector::z)};
}

void move_a(Difference& difference, const Vec3& sweep, const mpq_class& t) {
  const Vector3<mpq_class> by = t * in_units(difference, sweep);
  const Integer finer =
      least_common_multiple(least_common_multiple(by.x.get_den(), by.y.get_den()), by.z.get_den());
  refine_unit(difference, finer);
  const auto in_finer = [&](const mpq_class& x) {
    return Integer(x.get_num() * (finer / x.get_den()));
  };
  difference.d = difference.d + IntegerVector{in_finer(by.x), in_finer(by.y), in_finer(by.z)};
}

}  // namespace touchstone::oracle
