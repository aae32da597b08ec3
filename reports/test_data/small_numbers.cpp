#include "reports/test_data/small_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "properties/numbers.hpp"
#include "reports/test_data/test_data.hpp"

namespace touchstone {

Meeting meeting_of(const Configuration& c, const oracle::Truth& truth, double tolerance) {
  const oracle::Enclosure& distance = truth.signed_distance;
  using enum Meeting::Kind;
  const double middle = distance.midpoint();
  const auto kind = distance.lo == 0 && distance.hi == 0 ? touching
                    : middle < -smaller_size(c) / 4      ? deep
                    : middle < -sure * tolerance         ? shallow
                    : middle > sure * tolerance          ? apart
                                                         : near;
  const oracle::OptimalNormal& n = truth.normals.front();
  return {kind, truth.ties, n.to_a, n.to_b, n.support_b.size(), oracle::contact_patch(c, n).kind()};
}

Configuration on_grid(const Configuration& c, bool in_frame_of_b, int bits) {
  Numbers numbers = numbers_of(c);
  if (in_frame_of_b) {
    const Eigen::Quaterniond back = c.pose_b.unit_orientation().conjugate();
    numbers.position_a = back * (numbers.position_a - numbers.position_b);
    numbers.orientation_a = back * c.pose_a.unit_orientation();
    numbers.position_b.setZero();
    numbers.orientation_b.setIdentity();
  }
  const double grid = std::ldexp(1.0, std::ilogb(smaller_size(c)) - bits);
  // Never the zero with a sign.
  const auto round = [grid](double x) { return std::round(x / grid) * grid + 0.0; };
  for (double& size : numbers.sizes) size = std::max(grid, round(size));
  for (Vec3& vertex : numbers.vertices) vertex = vertex.unaryExpr(round);
  for (Vec3* v : {&numbers.position_a, &numbers.position_b}) *v = v->unaryExpr(round).eval();
  for (Eigen::Quaterniond* q : {&numbers.orientation_a, &numbers.orientation_b}) {
    q->coeffs() *= std::ldexp(1.0, bits / 2) / q->coeffs().cwiseAbs().maxCoeff();
    q->coeffs() = (q->coeffs().array().round() + 0.0).matrix().eval();
  }
  numbers.displacement = round(numbers.displacement);
  return configuration_of(numbers);
}

void touch(Configuration& c) {
  const oracle::Truth truth = oracle::truth(c);
  const Vec3 n = truth.normals.front().n.unaryExpr(
      [](double x) { return std::abs(x) < negligible_component ? 0 : x; });
  const Vec3 by = -truth.signed_distance.midpoint() * n;
  c.pose_a = Pose(c.pose_a.position() + by, c.pose_a.orientation());
}

Configuration in_floats(const Configuration& c) {
  Numbers numbers = numbers_of(c);
  for (double* const x : every_number(numbers)) *x = static_cast<float>(*x);
  return configuration_of(numbers);
}

bool is_in_floats(const Configuration& c) {
  Numbers numbers = numbers_of(c);
  const auto all = every_number(numbers);
  return std::all_of(all.begin(), all.end(), [](const double* x) {
    return static_cast<double>(static_cast<float>(*x)) == *x &&
           (*x == 0 || std::abs(*x) >= std::numeric_limits<float>::min());
  });
}

double moved_by_rounding(const Configuration& c) {
  const auto* const plane = std::get_if<Plane>(&c.b);
  const double sizes = 2 * larger_size(c) + (plane ? std::abs(plane->unit_displacement()) : 0);
  return float_rounding * (sizes + c.pose_a.position().norm() + c.pose_b.position().norm());
}

}  // namespace touchstone
