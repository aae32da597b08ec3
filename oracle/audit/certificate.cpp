// Searches in 400 bits, shortens every number to the digits that its claim needs, and checks the
// claims about points and cells in rationals.
#include "oracle/audit/certificate.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "oracle/audit/branch_and_bound.hpp"
#include "oracle/audit/rational.hpp"
#include "oracle/audit/unit.hpp"

namespace touchstone::audit {
namespace {

using Real400 = Multiprecision;

constexpr int most_closest_steps = 2000;
constexpr int bits_step = 24, most_bits = 480;
/// The ends' grain is finer than the width by this many bits.
constexpr int tight_bits = 20;

Vector<Real400> as_reals(const Vector<Rational>& v) { return as<Real400>(v); }
PointPair<Real400> as_reals(const PointPair<Rational>& pair) {
  return {as<Real400>(pair.a), as<Real400>(pair.b)};
}

/// More than 400 bits lose in a bound.
const Real400& rounding() {
  static const Real400 value = ldexp(Real400(1), -340);
  return value;
}

[[noreturn]] void fail() {
  throw std::logic_error("certificate: a bound of the search does not hold exactly");
}

Rational grain_of(int bits) { return rounded(ldexp(Real400(1), -bits), bits, MPFR_RNDZ); }

/// The smallest multiple of 2^−bits that `holds`, exactly; it is not above `bound` + `error` by
/// more.
template <class Holds>
Rational tight_above(const Real400& bound, const Real400& error, int bits, const Holds& holds) {
  Rational first = rounded(bound - error, bits, MPFR_RNDU);
  if (holds(first)) return first;
  Rational second = rounded(bound + error, bits, MPFR_RNDU);
  if (!holds(second)) fail();
  return second;
}

/// The pair with as few digits as `proves` its difference; its points lie in the bodies, exactly.
template <class Proves>
PointPair<Rational> shortest(const Bodies<Rational>& bodies, const PointPair<Real400>& pair,
                             const Proves& proves) {
  for (int bits = bits_step; bits <= most_bits; bits += bits_step) {
    PointPair<Rational> candidate = truncated(pair, bits);
    if (certainly_contain(bodies, candidate) && proves(difference(bodies, candidate))) {
      return candidate;
    }
  }
  fail();
}

/// A normal with few digits whose gap is not below `wanted`.
Vector<Rational> shortest_normal(const Bodies<Real400>& bodies, const Vector<Real400>& normal,
                                 const Real400& wanted) {
  const Vector<Real400> unit_normal = normal / Real400(sqrt(Real400(normal.squaredNorm())));
  for (int bits = bits_step; bits <= most_bits; bits += bits_step) {
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

/// Proofs about one configuration but a half-space, in units.
class Prover {
 public:
  Prover(const Configuration& c, double unit, const Real400& width, int cells)
      : unit_(unit),
        bodies_(make_bodies<Real400>(c, unit)),
        exact_(make_bodies<Rational>(c, unit)),
        found_(BranchAndBound<Real400>(bodies_, bodies_)
                   .run(ClosestPairSearch<Real400>(bodies_).run(width / 8, most_closest_steps),
                        width / 2, cells)),
        room_(std::max(Real400(width / 2), Real400(found_.hi - found_.lo)) / 4 + rounding()),
        grain_(tight_bits + std::max(bits_of(room_), found_.hi < 0 ? bits_of(-found_.hi) : 0)) {}

  Certificate certificate() const {
    const Vector<Rational> normal = shortest_normal(bodies_, found_.normal, found_.lo - room_);
    const Rational lo =
        rounded(gap_below(bodies_, as_reals(normal)) - rounding(), grain_, MPFR_RNDD);
    Certificate result{in_metres(lo, unit_), {},           in_metres(grain_of(grain_), unit_),
                       in_metres(normal, 1), std::nullopt, {}};
    if (found_.hi < -rounding()) {  // cells would have to prove less than what 400 bits lose
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
    const Rational hi =
        tight_above(distance_above(bodies_, as_reals(pair)), rounding(), grain_,
                    [&](const Rational& end) { return end >= 0 && closer(w, end); });
    result.hi = in_metres(hi, unit_);
    result.pair = in_metres(pair, unit_);
  }

  void prove_by_cells(Certificate& result) const {
    // Stays negative, as a bound by cells must.
    const Real400 above = std::min(Real400(found_.hi + room_), Real400(found_.hi / 2));
    const Rational goal = rounded(above, grain_, MPFR_RNDU);
    std::vector<Vector<Rational>> differences;
    std::vector<DirectionCell<Rational>> cells;
    Real400 bound = found_.lo;
    for (const auto& [cell, pair, ignored_bound, ignored_promise] : found_.cells) {
      cells.push_back(exact_cell(cell));
      const PointPair<Rational> short_pair =
          shortest(exact_, pair, [&](const auto& w) { return bounds_cell(w, cells.back(), goal); });
      differences.push_back(difference(exact_, short_pair));
      bound = std::max(bound, corner_bound_above(bodies_, as_reals(short_pair), cell));
      result.cells.push_back({path_of(cell), in_metres(short_pair, unit_)});
    }
    const Rational hi = tight_above(bound, rounding(), grain_, [&](const Rational& end) {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!bounds_cell(differences[i], cells[i], end)) return false;
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
  Real400 room_;  // what shortening may cost at each end
  int grain_;     // bits of the ends' grain
};

/// Over a half-space: a point of A, the plane's point nearest to its origin, its own normal.
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
  const Real400 gap = (gap_times_length(bodies, n) - Real400(displacement)) / length;
  // A short normal may put the plane farther away than any unit.
  const Real400 far = abs(Real400(displacement)) / length;
  const Real400 error = rounding() * std::max(Real400(1), far);
  const int grain = bits_of(width / 4) + tight_bits;

  const Rational goal = rounded(gap + width / 4 + error, grain, MPFR_RNDU);
  PointPair<Rational> pair;
  Rational along;  // the normal, times its length
  for (int bits = bits_step; bits <= most_bits; bits += bits_step) {
    pair = {truncated(lowest, bits), b};
    along = difference(exact, pair).dot(normal);
    if (certainly_contains(exact.a, pair.a) && at_most(along, goal, squared)) break;
  }
  if (!certainly_contains(exact.a, pair.a)) fail();
  const Rational hi = tight_above(Real400(along) / length, error, grain, [&](const Rational& end) {
    return at_most(along, end, squared);
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
