#include "reports/test_data/cast_limits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace touchstone {
namespace {

/// To which part of the tolerance the limits are found.
constexpr double limits_accuracy = 0x1p-10;

/// The time nearest to `from`, towards `to`, at which the signed distance is at most `level`, or
/// missing it by no more than `slack`. Newton's method: the tangent of a convex function lies below
/// it, so that no step leads too far, and one that does not fall proves that there is none.
std::optional<double> first_at_most(const Configuration& c, const Vec3& sweep, double level,
                                    double slack, double from, double to) {
  const double direction = to > from ? 1 : -1;
  for (double t = from; (to - t) * direction >= 0;) {
    const oracle::Truth truth = oracle::truth_at(c, sweep, mpq_class(t), 1e-15);
    const double excess = truth.signed_distance.midpoint() - level;
    if (excess <= slack) return t;
    const double slope = direction * sweep.dot(truth.normals.front().n);
    if (!(slope < 0)) return {};
    t -= direction * excess / slope;
  }
  return {};
}

}  // namespace

CastLimits cast_limits(const Configuration& c, const Vec3& sweep, const oracle::FirstTouch& truth,
                       double tolerance) {
  using enum AnswerLimits::Contact;
  const double slack = limits_accuracy * tolerance;
  const auto first = [&](double level, double from, double to) {
    return first_at_most(c, sweep, level, slack, from, to);
  };
  const std::optional<double> near = first(tolerance, 0, 1);
  if (!near) return {forbidden, tolerance, 1, 0};
  const double touch = truth.fraction.midpoint();
  const std::optional<double> deep = first(-tolerance, touch, 1);
  const double last = deep ? *deep : first(tolerance, 1, 0).value_or(*near);
  // A start that is deep allows what moves A by the tolerance.
  const bool is_never = truth.status == oracle::FirstTouch::Status::never;
  const double moves = is_never ? 0 : std::min(1.0, touch + tolerance / sweep.norm());
  const int bits = std::max(0, std::ilogb(sweep.norm() / slack) + 1);
  return {deep ? required : optional, tolerance,
          std::ldexp(std::floor(std::ldexp(*near, bits)), -bits),
          std::min(1.0, std::ldexp(std::ceil(std::ldexp(std::max(last, moves), bits)), -bits))};
}

}  // namespace touchstone
