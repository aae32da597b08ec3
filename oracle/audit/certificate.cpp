// Searches in 400 bits, shortens every number to the digits that its claim needs, and checks in
// rationals what is claimed of points and cells.
#include "oracle/audit/certificate.hpp"

#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <stdexcept>
#include <string>

#include "oracle/audit/branch_and_bound.hpp"
#include "oracle/audit/certain_bounds.hpp"

namespace touchstone::audit {
namespace {

/// Exact arithmetic for what a certificate claims.
using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational,
                                               boost::multiprecision::et_off>;

/// Rounds to a multiple of 2^−bits: towards zero, down or up.
Rational rounded(const Multiprecision& x, int bits, mpfr_rnd_t direction) {
  const Multiprecision scaled = ldexp(x, bits);
  mpq_class q;
  mpfr_get_z(q.get_num_mpz_t(), scaled.backend().data(), direction);
  q /= mpz_class(1) << static_cast<mp_bitcnt_t>(bits);
  return Rational(q.get_mpq_t());
}

/// Truncates the coordinates. Every shape but the half-space contains a point of it after its local
/// coordinates have moved towards zero.
Vector<Rational> truncated(const Vector<Multiprecision>& v, int bits) {
  return {rounded(v.x(), bits, MPFR_RNDZ), rounded(v.y(), bits, MPFR_RNDZ),
          rounded(v.z(), bits, MPFR_RNDZ)};
}

PointPair<Rational> truncated(const PointPair<Multiprecision>& pair, int bits) {
  PointPair<Rational> result{truncated(pair.a, bits), truncated(pair.b, bits)};
  for (const auto& [vertex, weight] : pair.weights) {
    const Rational shorter = rounded(weight, bits, MPFR_RNDZ);
    if (shorter != 0) result.weights.push_back({vertex, shorter});
  }
  return result;
}

/// Bits after the binary point that resolve a small positive length.
int bits_of(const Multiprecision& length) {
  return std::max(0, 2 - static_cast<int>(ilogb(length)));
}

/// Is product <= bound · √square? Decided without a root.
bool at_most(const Rational& product, const Rational& bound, const Rational& square) {
  const Rational p = product * product, b = bound * bound * square;
  return bound < 0 ? product <= 0 && p >= b : product <= 0 || p <= b;
}

DirectionCell<Rational> exact_cell(const DirectionCell<Multiprecision>& cell) {
  const auto exact = [&](const Multiprecision& x) { return rounded(x, cell.level, MPFR_RNDZ); };
  return {cell.face, cell.level, exact(cell.u), exact(cell.v), exact(cell.size)};
}

/// Path of a cell, as in Certificate::Cell::path.
std::string path_of(const DirectionCell<Multiprecision>& cell) {
  std::string path = std::to_string(cell.face);
  auto at = DirectionCell<Multiprecision>::whole_face(cell.face);
  for (int level = 0; level < cell.level; ++level) {
    const Multiprecision half = at.size / 2;
    const int quarter = (cell.u >= at.u + half ? 1 : 0) + (cell.v >= at.v + half ? 2 : 0);
    path += static_cast<char>('0' + quarter);
    at = at.child(quarter);
  }
  return path;
}

mpq_class in_metres(const Rational& units, double unit) {
  return mpq_class(units.backend().data()) * mpq_class(unit);
}
RationalVector in_metres(const Vector<Rational>& v, double unit) {
  return {in_metres(v.x(), unit), in_metres(v.y(), unit), in_metres(v.z(), unit)};
}
RationalPair in_metres(const PointPair<Rational>& pair, double unit) {
  RationalPair result{in_metres(pair.a, unit), in_metres(pair.b, unit), {}};
  for (const auto& [vertex, weight] : pair.weights) {
    result.weights.emplace_back(vertex, in_metres(weight, 1));
  }
  return result;
}

using Real400 = Multiprecision;

constexpr int max_closest_steps = 2000;
constexpr int bits_step = 24, max_bits = 480;
/// The grain of the ends is finer than the width by this many bits.
constexpr int tight_bits = 20;

Vector<Real400> as_reals(const Vector<Rational>& v) { return as<Real400>(v); }

/// Upper bound of the rounding error of a bound in 400 bits.
const Real400& rounding() {
  static const Real400 value = ldexp(Real400(1), -340);
  return value;
}

[[noreturn]] void fail() {
  throw std::logic_error("certificate: a bound of the search does not hold exactly");
}

Rational grain_of(int bits) { return rounded(ldexp(Real400(1), -bits), bits, MPFR_RNDZ); }

/// The smallest multiple of 2^−bits for which `holds` is exactly true; it lies within one multiple
/// above `bound` + `error`.
template <class Holds>
Rational tight_above(const Real400& bound, const Real400& error, int bits, const Holds& holds) {
  Rational first = rounded(bound - error, bits, MPFR_RNDU);
  if (holds(first)) return first;
  Rational second = rounded(bound + error, bits, MPFR_RNDU);
  if (!holds(second)) fail();
  return second;
}

/// The pair truncated to the fewest digits for which `proves` accepts its difference and its points
/// lie exactly in the bodies.
template <class Proves>
PointPair<Rational> shortest(const Bodies<Rational>& bodies, const PointPair<Real400>& pair,
                             const Proves& proves) {
  for (int bits = bits_step; bits <= max_bits; bits += bits_step) {
    PointPair<Rational> candidate = truncated(pair, bits);
    if (certainly_contain(bodies, candidate) && proves(difference(bodies, candidate))) {
      return candidate;
    }
  }
  fail();
}

/// A normal of few digits whose gap is at least `wanted`.
Vector<Rational> shortest_normal(const Bodies<Real400>& bodies, const Vector<Real400>& normal,
                                 const Real400& wanted) {
  const Vector<Real400> unit_normal = normal / Real400(sqrt(Real400(normal.squaredNorm())));
  for (int bits = bits_step; bits <= max_bits; bits += bits_step) {
    Vector<Rational> n = truncated(unit_normal, bits);
    if (n != Vector<Rational>::Zero() && gap_below(bodies, as_reals(n)) >= wanted) return n;
  }
  fail();
}

bool bounds_cell(const Vector<Rational>& w, const DirectionCell<Rational>& cell,
                 const Rational& hi) {
  for (const Vector<Rational>& m : cell.corners()) {
    if (!at_most(w.dot(m), hi, m.squaredNorm())) return false;
  }
  return true;
}

/// Makes certificates for any shape but the half-space; lengths in units.
class Prover {
 public:
  Prover(const Configuration& c, double unit, const Real400& width, int cells)
      : unit_(unit),
        bodies_(make_bodies<Real400>(c, unit)),
        exact_(make_bodies<Rational>(c, unit)),
        found_(BranchAndBound<Real400>(bodies_, bodies_)
                   .run(ClosestPairSearch<Real400>(bodies_).run(width / 8, max_closest_steps),
                        width / 2, cells)),
        room_(std::max(Real400(width / 2), Real400(found_.hi - found_.lo)) / 4 + rounding()),
        grain_(tight_bits + std::max(bits_of(room_), found_.hi < 0 ? bits_of(-found_.hi) : 0)) {}

  Certificate certificate() const {
    const Vector<Rational> normal = shortest_normal(bodies_, found_.normal, found_.lo - room_);
    const Rational lo = rounded(
        gap_below(bodies_, as_reals(normal)) - bodies_.rounding - rounding(), grain_, MPFR_RNDD);
    Certificate result{in_metres(lo, unit_), {},           in_metres(grain_of(grain_), unit_),
                       in_metres(normal, 1), std::nullopt, {}};
    if (found_.hi <
        -rounding()) {  // a larger hi is within the rounding error, which cells cannot prove
      prove_by_cells(result);
    } else {
      prove_by_pair(result);
    }
    return result;
  }

 private:
  void prove_by_pair(Certificate& result) const {
    const Rational goal = rounded(found_.hi + room_, grain_, MPFR_RNDU);
    const auto closer = [](const Vector<Rational>& w, const Rational& hi) {
      return Rational(w.squaredNorm()) <= hi * hi;
    };
    const PointPair<Rational> pair =
        shortest(exact_, found_.closest, [&](const auto& w) { return closer(w, goal); });
    const Vector<Rational> w = difference(exact_, pair);
    const Rational hi = tight_above(distance_above(bodies_, as<Real400>(pair)) - bodies_.rounding,
                                    rounding(), grain_, [&](const Rational& end) {
                                      const Rational of_cores = end + exact_.rounding;
                                      return of_cores >= 0 && closer(w, of_cores);
                                    });
    result.hi = in_metres(hi, unit_);
    result.pair = in_metres(pair, unit_);
  }

  void prove_by_cells(Certificate& result) const {
    // Must stay negative: cells prove only negative bounds.
    const Real400 above = std::min(Real400(found_.hi + room_), Real400(found_.hi / 2));
    const Rational goal = rounded(above, grain_, MPFR_RNDU);
    std::vector<Vector<Rational>> differences;
    std::vector<DirectionCell<Rational>> cells;
    Real400 bound = found_.lo;
    for (const auto& [cell, pair, ignored_bound, ignored_estimate] : found_.cells) {
      cells.push_back(exact_cell(cell));
      const PointPair<Rational> short_pair =
          shortest(exact_, pair, [&](const auto& w) { return bounds_cell(w, cells.back(), goal); });
      differences.push_back(difference(exact_, short_pair));
      bound = std::max(bound, corner_bound_above(bodies_, as<Real400>(short_pair), cell));
      result.cells.push_back({path_of(cell), in_metres(short_pair, unit_)});
    }
    const Real400 above_all = bound - bodies_.rounding;
    const Rational hi = tight_above(above_all, rounding(), grain_, [&](const Rational& end) {
      const Rational of_cores = end + exact_.rounding;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!bounds_cell(differences[i], cells[i], of_cores)) return false;
      }
      return true;
    });
    result.hi = in_metres(hi, unit_);
    std::sort(result.cells.begin(), result.cells.end(),
              [](const auto& x, const auto& y) { return x.path < y.path; });
  }

  double unit_;
  Bodies<Real400> bodies_;
  Bodies<Rational> exact_;
  Bounds<Real400> found_;
  Real400 room_;  // what shortening may add at each end
  int grain_;     // bits of the ends' grain
};

/// Certificate for a half-space: a point of A, the plane's point nearest to its origin, the plane's
/// normal.
Certificate certify_over_plane(const Configuration& c, const Plane& plane, const Real400& width,
                               double unit) {
  const auto bodies = make_bodies<Real400>(c, unit);
  const auto exact = make_bodies<Rational>(c, unit);
  Vector<Rational> local;
  for (int i = 0; i < 3; ++i) local[i] = Rational(plane.normal()[i]);
  const Rational squared = local.squaredNorm();
  const Rational displacement = Rational(plane.displacement()) / Rational(unit);
  const Vector<Rational> normal = exact.b.axes * local;
  const Vector<Rational> b = local * Rational(displacement / squared);

  const Vector<Real400> n = as_reals(normal);
  const Real400 length = sqrt(Real400(squared));
  const Vector<Real400> toward = -(bodies.a.axes.transpose() * n);
  const Vector<Real400> lowest = pulled_inside(bodies.a, support_point(bodies.a, toward));
  const Real400 gap =
      (gap_times_length(bodies, n) - Real400(displacement)) / length - bodies.rounding;
  // With a short normal the plane may be many units away.
  const Real400 far = abs(Real400(displacement)) / length;
  const Real400 error = rounding() * std::max(Real400(1), far);
  const int grain = bits_of(width / 4) + tight_bits;

  const Rational goal = rounded(gap + width / 4 + error, grain, MPFR_RNDU);
  PointPair<Rational> pair;
  Rational along;  // component along the normal, times the normal's length
  for (int bits = bits_step; bits <= max_bits; bits += bits_step) {
    pair = {truncated(lowest, bits), b};
    along = difference(exact, pair).dot(normal);
    const Rational of_cores = goal + exact.rounding;
    if (certainly_contains(exact.a, pair.a) && at_most(along, of_cores, squared)) break;
  }
  if (!certainly_contains(exact.a, pair.a)) fail();
  const Real400 above = Real400(along) / length - bodies.rounding;
  const Rational hi = tight_above(above, error, grain, [&](const Rational& end) {
    return at_most(along, end + exact.rounding, squared);
  });
  const Rational lo = rounded(gap - error, grain, MPFR_RNDD);
  return {in_metres(lo, unit),  in_metres(hi, unit),   in_metres(grain_of(grain), unit),
          in_metres(normal, 1), in_metres(pair, unit), {}};
}

}  // namespace

Certificate certify(const Configuration& configuration, const Budget& budget) {
  check_width(budget.width);
  const double unit = unit_of(configuration);
  const double size = larger_size(configuration);
  const Real400 width = Real400(budget.width) * size / unit;
  if (const auto* plane = std::get_if<Plane>(&configuration.b)) {
    return certify_over_plane(configuration, *plane, width, unit);
  }
  return Prover(configuration, unit, width, budget.cells).certificate();
}

}  // namespace touchstone::audit
