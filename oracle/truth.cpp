#include "oracle/truth.hpp"

#include <CGAL/version.h>
#include <algorithm>
#include <arb.h>
#include <cmath>
#include <flint/flint.h>
#include <gmp.h>
#include <mpfr.h>
#include <optional>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

#include "oracle/body.hpp"
#include "oracle/displacement.hpp"
#include "oracle/enclosure.hpp"
#include "oracle/rounding.hpp"
#include "oracle/survivors.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

/// A gap below 2^-zero_bits of the larger size is not separated from zero.
constexpr long zero_bits = 1000;
constexpr long last_bits = 1L << 13;

/// If rounding to 2^-bits of the size leaves the sign open, the enclosure reaches less than 2^(8 −
/// bits) of the size beyond zero: eight lengths change by at most one multiple each, two
/// orientations by 12 and 18 (rounding.hpp), and balls separate four times that.
constexpr int bits_below_resolution = 8;

/// Gaps this close to the largest tie with it; relative to the larger size.
Float tie_tolerance(double width) {
  Float result(width);
  arf_mul_2exp_si(result.get(), result.get(), -20);
  return result;
}

/// Initial working precision: a little more than ties at this width need.
long initial_bits(double width) {
  return 128 + std::max(0L, static_cast<long>(-std::log2(width)) - 53);
}

/// Bits kept beyond the wanted width, so that rounding rarely leaves open in which cell a number
/// lies.
constexpr int bits_beyond_width = 92;

/// Normals closer than this are equal in double.
constexpr double same_normal = 1e-14;

/// Is it decided for every normal whether its gap is within `tie` of the largest?
bool ties_are_decided(const std::vector<Survivor>& survivors, const Maximum& best,
                      const Float& tie) {
  const Float may_tie = *best.lo - tie, ties = *best.hi - tie;
  std::size_t undecided = 0, reaching = 0;
  for (const auto& survivor : survivors) {
    for (const auto& bound : survivor.bounds) {
      if (!bound.normal || bound.gap.upper_end() < may_tie) continue;
      ++reaching;
      if (bound.gap.lower_end() < ties) ++undecided;
    }
  }
  // A single remaining normal is the largest, however wide its bound is.
  return undecided == 0 || reaching == 1;
}

Vec3 in_world(const Difference& difference, const BallVector& n) {
  // Rounding each coordinate and one normalisation: an error of a few ulp.
  const auto coordinate = [&](int row) { return dot(to_balls(difference.world_rows[row]), n); };
  const BallVector world{coordinate(0), coordinate(1), coordinate(2)};
  const BallVector unit = (Ball(1) / norm(world)) * world;
  return Vec3(unit.x.midpoint(), unit.y.midpoint(), unit.z.midpoint()).normalized();
}

Alignment alignment(CriticalDirection& direction, const IntegerVector& axis, const IntegerVector& e,
                    const IntegerVector& f) {
  if (direction.is_across(axis)) return Alignment::perpendicular;
  if (direction.is_across(e) && direction.is_across(f)) return Alignment::parallel;
  return Alignment::oblique;
}

/// The vertices of a hull that are the highest along the direction, of which n is the ball: exactly
/// as high as one that no other is above.
std::vector<int> hull_support(const Difference::Hull& hull, const BallDifference& balls,
                              CriticalDirection& direction, const BallVector& n) {
  std::vector<int> result = balls.highest(n);
  const auto height = [&](int i) { return dot(balls.vertex(i), n); };
  const int top = *std::max_element(result.begin(), result.end(), [&](int i, int k) {
    return arf_cmp(arb_midref(height(i).get()), arb_midref(height(k).get())) < 0;
  });
  std::erase_if(result, [&](int i) {
    const bool may_be_as_high = i == top || (height(i) - height(top)).contains_zero();
    return !may_be_as_high || !direction.is_across(hull.vertices[i] - hull.vertices[top]);
  });
  return result;
}

/// The same vertices of the body as given, which may have more: some that are no corners, or that
/// rounding has merged.
std::vector<int> indices_in(const Convex& given, const Convex& rounded, std::vector<int> vertices) {
  const auto& all = given.vertices();
  if (all.size() == rounded.vertices().size()) return vertices;
  for (int& v : vertices) {
    const Vec3& at = rounded.vertices()[v];
    const auto nearest =
        std::min_element(all.begin(), all.end(), [&](const Vec3& a, const Vec3& b) {
          return (a - at).stableNorm() < (b - at).stableNorm();
        });
    v = static_cast<int>(nearest - all.begin());
  }
  return vertices;
}

OptimalNormal optimal_normal(const Difference& difference, const Shape& b,
                             const BallDifference& balls, CriticalDirection& direction,
                             const Vec3& n, const BallVector& exact) {
  OptimalNormal result;
  result.n = n;
  if (const auto* const body = std::get_if<Convex>(&b)) {
    result.support_b = indices_in(*body, difference.hull->body,
                                  hull_support(*difference.hull, balls, direction, exact));
  }
  result.to_a = alignment(direction, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  const auto& axes = difference.axes_b;
  const auto to_b = [&](int i) {
    return alignment(direction, axes[i], axes[(i + 1) % 3], axes[(i + 2) % 3]);
  };
  const Vec3 half_extents = Body(b).half_extents;
  for (int i = 0; i < 3; ++i) {
    if (half_extents[i] > 0) result.to_b[i] = to_b(i);
  }
  return result;
}

NormalFamily in_world(const Difference& difference, const DirectionFamily& family) {
  NormalFamily result{family.kind, Vec3::Zero(), {}};
  const auto world = [&](const IntegerVector& v) { return in_world(difference, to_balls(v)); };
  if (family.kind != NormalFamily::Kind::curve) result.axis = world(family.axis);
  for (const IntegerVector& end : family.ends) result.ends.push_back(world(end));
  return result;
}

/// Both ends of an edge have the same arc across it.
bool is_same_family(const NormalFamily& a, const NormalFamily& b) {
  const auto near = [](const Vec3& x, const Vec3& y) { return (x - y).norm() < same_normal; };
  return a.kind == b.kind && near(a.axis, b.axis) &&
         std::equal(a.ends.begin(), a.ends.end(), b.ends.begin(), b.ends.end(), near);
}

/// The arc between the two directions with the largest angle.
NormalFamily arc_between(const std::vector<OptimalNormal>& normals) {
  NormalFamily arc{NormalFamily::Kind::arc, Vec3::Zero(), {normals[0].n, normals[1].n}};
  for (const auto& a : normals) {
    for (const auto& b : normals) {
      if (a.n.dot(b.n) < arc.ends[0].dot(arc.ends[1])) arc.ends = {a.n, b.n};
    }
  }
  arc.axis = arc.ends[0].cross(arc.ends[1]).normalized();
  return arc;
}

/// Sites are ordered from simple to complex, so that a direction with several sites is known by the
/// simplest.
void set_normals(const Difference& difference, const Shape& b, const BallDifference& balls,
                 const std::vector<Survivor>& survivors, Truth& truth) {
  for (const auto& [direction, bounds] : survivors) {
    if (const auto exact = direction->family()) {
      const NormalFamily family = in_world(difference, *exact);
      const bool known =
          std::any_of(truth.families.begin(), truth.families.end(),
                      [&](const NormalFamily& f) { return is_same_family(f, family); });
      const bool is_needed = family.kind != NormalFamily::Kind::curve || truth.families.empty();
      if (is_needed && !known) truth.families.push_back(family);
    }
    for (const auto& bound : bounds) {
      if (!bound.normal) continue;
      const Vec3 n = in_world(difference, *bound.normal);
      const bool known =
          std::any_of(truth.normals.begin(), truth.normals.end(),
                      [&](const OptimalNormal& m) { return (m.n - n).norm() < same_normal; });
      if (!known) {
        truth.normals.push_back(optimal_normal(difference, b, balls, *direction, n, *bound.normal));
      }
    }
  }
  // As a function of vectors of any length g is concave and homogeneous, so that two normals of gap
  // zero make the whole arc between them optimal; of rounded bodies, two along which their cores
  // touch. Capsules and spheres have their families by themselves.
  mpq_class inflation(difference.inflation, difference.per_metre);
  inflation.canonicalize();
  const auto& [lo, hi] = truth.signed_distance;
  const bool touching = lo + inflation <= 0 && 0 <= hi + inflation;
  if (touching && truth.normals.size() > 1 && (inflation == 0 || truth.families.empty())) {
    const NormalFamily arc = arc_between(truth.normals);
    // Opposite normals reach zero only if a body is so thin that nothing tells its widths from it.
    const bool are_opposite = (arc.ends[0] + arc.ends[1]).norm() < same_normal;
    if (!are_opposite) truth.families = {arc};
  }
  truth.ties = !truth.families.empty()    ? Ties::continuum
               : truth.normals.size() > 1 ? Ties::finite
                                          : Ties::unique;
}

void check(const char* field, double value, bool good, const char* remedy) {
  if (!good) throw InvalidInput(field, std::to_string(value), remedy);
}

/// Bits after the binary point of a positive number.
int bits_of(double x) { return std::max(0, -std::ilogb(x)); }

/// The question and the accuracy wanted.
struct Request {
  const Configuration& configuration;
  double width, tie;
  int resolution = kept_bits;   ///< bits kept by rounding (rounding.hpp)
  const Vec3* sweep = nullptr;  ///< of which A has gone the part `t`
  mpq_class t = 0;
};

/// Bound of what rounding and bringing nearer change.
Float error_in_units(const RoundedConfiguration& question, const Difference& difference,
                     const std::optional<FarBodies>& far) {
  mpq_class error = question.error;
  if (error != 0) error *= difference.per_metre;
  if (far) error += far->error();
  return error == 0 ? Float() : Ball(error).upper_end();
}

/// None if the rounding of `question` leaves the answer open.
std::optional<Truth> truth_of(const RoundedConfiguration& question, const Request& wanted) {
  Difference difference = exact_difference(question.configuration);
  if (wanted.sweep) move_a(difference, *wanted.sweep, wanted.t);
  const auto far = FarBodies::brought_nearer(difference, wanted.resolution);
  const double size = larger_size(wanted.configuration);
  const GridCell cell(size, wanted.width);
  // Lengths in units from here on.
  const Float error = error_in_units(question, difference, far);
  const Float larger = Float(size) * Float(difference.per_metre);
  const double slack = std::max(wanted.width, wanted.tie);
  const Float slack_in_units = Float(slack) * larger;
  const Float tie = std::max(Float(wanted.tie), tie_tolerance(wanted.width)) * larger;

  std::vector<Survivor> survivors = all_directions(difference, slack * size);
  std::optional<Enclosure> signed_distance;
  for (long bits = initial_bits(wanted.width); bits <= last_bits; bits *= 2) {
    const WorkingPrecision precision(bits);
    const BallDifference balls(difference);
    enclose(survivors, difference, balls);
    const Maximum best = maximum(survivors);
    if (!best.lo) continue;
    drop_below(survivors, *best.lo - slack_in_units);
    if (!best.hi) continue;

    if (!signed_distance) {
      Float lo = *best.lo - error, hi = *best.hi + error;
      if (far) {
        const Ball shift = far->shift();
        lo = lo + shift.lower_end();
        hi = hi + shift.upper_end();
      }
      signed_distance = cell.around(lo, hi, difference.per_metre);
      const bool is_exact = error.sign() == 0;
      const bool may_be_zero = lo.sign() <= 0 && 0 <= hi.sign();
      if (!signed_distance && may_be_zero && is_exact && is_exactly_zero(survivors, difference)) {
        signed_distance = {0, 0};
      }
      // The rounding, not the precision, leaves the answer open.
      const bool needs_resolution = !is_exact && !(Float(4) * error < hi - lo);
      if (!signed_distance && needs_resolution && !may_be_zero) return std::nullopt;
      if (!signed_distance) {
        const Enclosure nearly_zero =
            cell.nearly_zero(is_exact ? zero_bits : wanted.resolution - bits_below_resolution);
        const auto in_metres = [&](const Float& x) {
          return mpq_class(x.rational() / difference.per_metre);
        };
        if (nearly_zero.lo <= in_metres(lo) && in_metres(hi) <= nearly_zero.hi) {
          signed_distance = nearly_zero;
        }
      }
      if (!signed_distance) continue;
    }
    if (!ties_are_decided(survivors, best, tie) && 2 * bits <= last_bits) continue;

    Truth result{*signed_distance, {}, Ties::unique, {}};
    drop_below(survivors, *best.lo - tie);
    set_normals(difference, wanted.configuration.b, balls, survivors, result);
    return result;
  }
  throw std::logic_error("oracle: the signed distance could not be enclosed");
}

Truth answered(Request wanted) {
  const double width = wanted.width, tie = wanted.tie;
  check("width", width, std::isfinite(width) && width > 0, "must be positive and finite");
  check("tie", tie, std::isfinite(tie) && tie >= 0, "must not be negative, and finite");
  const int min_bits = std::max(kept_bits, bits_of(width) + bits_beyond_width);
  for (wanted.resolution = min_bits;; wanted.resolution *= 2) {
    const RoundedConfiguration question =
        rounded_configuration(wanted.configuration, wanted.resolution);
    if (auto answer = truth_of(question, wanted)) return *answer;
  }
}

}  // namespace

Truth truth(const Configuration& configuration, double width, double tie) {
  return answered({configuration, width, tie});
}

Truth truth_at(const Configuration& configuration, const Vec3& sweep, const mpq_class& t,
               double width, double tie) {
  return answered({configuration, width, tie, kept_bits, &sweep, t});
}

std::vector<std::string> libraries() {
  const auto eigen = std::to_string(EIGEN_WORLD_VERSION) + '.' +
                     std::to_string(EIGEN_MAJOR_VERSION) + '.' +
                     std::to_string(EIGEN_MINOR_VERSION);
  return {std::string("CGAL ") + CGAL_VERSION_STR,   std::string("GMP ") + gmp_version,
          std::string("MPFR ") + mpfr_get_version(), std::string("FLINT ") + flint_version,
          std::string("Arb ") + arb_version,         "Eigen " + eigen};
}

}  // namespace touchstone::oracle
