#include "oracle/audit/enclose.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/audit/branch_and_bound.hpp"
#include "oracle/audit/certain_bounds.hpp"

namespace touchstone::audit {
namespace {

/// Encloses the signed distance from a half-space, whose gap is finite only along its own normal:
/// by the height of a point of A.
Enclosure over_plane(const Configuration& c, const Plane& plane, double unit) {
  const auto bodies = make_bodies<Interval>(c, unit);
  const auto search = make_bodies<double>(c, unit);
  const double scale = std::ldexp(1.0, std::ilogb(plane.normal().cwiseAbs().maxCoeff()));
  const Vec3 scaled = plane.normal() / scale;
  Vector<Interval> local;
  for (int i = 0; i < 3; ++i) local[i] = Interval(plane.normal()[i]) / Interval(scale);
  const Vector<Interval> n = bodies.b.axes * local;
  const Interval length = sqrt(Interval(local.squaredNorm()));
  const Interval level =
      Interval(plane.displacement()) / Interval(unit) / Interval(scale) / length + bodies.rounding;

  const Vector<double> world = search.b.axes * scaled;
  const Vector<double> toward = -(search.a.axes.transpose() * world);
  const Vector<double> lowest = pulled_inside(search.a, support_point(search.a, toward));
  const bool inside = certainly_contains(bodies.a, lowest);
  const Vector<Interval> point = bodies.a.axes * as<Interval>(inside ? lowest : Vec3(0, 0, 0));
  const Interval height = Interval(bodies.offset.dot(n) + point.dot(n)) / length - level;
  const Interval gap = gap_times_length(bodies, n) / length - level;
  const double hi = upper(Interval(height * Interval(unit)));
  return {lower(Interval(gap * Interval(unit))), hi, world.normalized(), std::max(hi, 0.0), 0};
}

constexpr int max_steps = 200;

/// Doubles suffice unless the bodies nearly touch, or rounding stops the search, as it does of
/// features that are parallel. If they nearly touch, the pair's difference is too short for its
/// direction to be known: an error of 1e-16 in its square is a length of 1e-8.
ClosestPair<double> closest_pair(const Configuration& c, const Bodies<double>& search,
                                 double unit) {
  constexpr double tolerance = 1e-15, nearly_touching = 1e-6;
  auto found = ClosestPairSearch<double>(search).run(tolerance, max_steps);
  const double distance = difference(search, found.pair).norm();
  const double enough = distance > nearly_touching ? 1e-10 : 1e-13;
  if (distance - found.gap < enough || found.gap < -nearly_touching) return found;
  const auto precise = make_bodies<Multiprecision>(c, unit);
  const auto again = ClosestPairSearch<Multiprecision>(precise).run(tolerance, max_steps);
  return {as<double>(again.pair), as<double>(again.direction), again.gap.convert_to<double>()};
}

}  // namespace

Enclosure enclose(const Configuration& configuration, const Budget& budget) {
  check_width(budget.width);
  const CGAL::Protect_FPU_rounding<true> rounding_outward;
  const double unit = unit_of(configuration);
  if (const auto* plane = std::get_if<Plane>(&configuration.b)) {
    return over_plane(configuration, *plane, unit);
  }
  const auto certain = make_bodies<Interval>(configuration, unit);
  const auto search = make_bodies<double>(configuration, unit);
  const double width = budget.width * (larger_size(configuration) / unit);
  const ClosestPair<double> closest = closest_pair(configuration, search, unit);
  const auto found = BranchAndBound<Interval>(certain, search).run(closest, width, budget.cells);
  const auto metres = [&](double units) {
    return (Interval(units) - certain.rounding) * Interval(unit);
  };
  return {lower(metres(found.lo)), upper(metres(found.hi)), found.normal.normalized(),
          upper(metres(found.distance)), found.programs};
}

}  // namespace touchstone::audit
