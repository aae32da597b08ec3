// Configurations in which only the agreement of the routines with each other is judged.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "properties/identity.hpp"
#include "properties/mutation/cases.hpp"

namespace touchstone::mutation {
namespace {

/// Two cylinders whose rims meet along a chosen normal at a chosen depth, so that they are mostly
/// deepest there. Angles and ratios are log-uniform, because searches fail where one is small.
class MeetingRims {
 public:
  explicit MeetingRims(std::uint64_t index) : random_(index) {}

  Configuration make() {
    const double r1 = log_uniform(-3, 1), r2 = coin() ? r1 : r1 * log_uniform(0, 2);
    const double h1 = r1 * log_uniform(-8, 1), h2 = r2 * log_uniform(-8, 1);
    const double tilt = coin() ? log_uniform(-9, 0) : std::numbers::pi / 2 - small_or_none();
    const Vec3 u1(1, 0, 0), u2(std::cos(tilt), std::sin(tilt), 0);
    const Vec3 n = normal(tilt);
    const Vec3 across1 = n - n.dot(u1) * u1, across2 = n - n.dot(u2) * u2;
    // Deeper than this the sum of the rims is less round than the sphere about the origin.
    const double max_depth = std::min(r1 / across1.norm(), r2 / across2.norm());
    const double part = coin() ? log_uniform(-8, 0) : 1 - log_uniform(-8, 0);
    const double gap = uniform(0, 1) < 0.1 ? r1 * log_uniform(-9, 0) : -part * max_depth;
    const Vec3 d = gap * n + r1 * across1.normalized() + r2 * across2.normalized() +
                   std::copysign(h1, n.dot(u1)) * u1 + std::copysign(h2, n.dot(u2)) * u2;
    const auto along = [](const Vec3& axis) {
      return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis);
    };
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))
            .normalized();
    return {Cylinder(r1, h1), Pose(turn * d, turn * along(u1)), Cylinder(r2, h2),
            Pose(Vec3::Zero(), turn * along(u2))};
  }

 private:
  double uniform(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random_); }
  double log_uniform(double lo, double hi) { return std::pow(10, uniform(lo, hi)); }
  bool coin() { return uniform(0, 1) < 0.5; }
  double small_or_none() { return coin() ? 0 : log_uniform(-16, -1); }

  /// Near an axis, across both within the angle between them, or anywhere.
  Vec3 normal(double tilt) {
    const double kind = uniform(0, 3);
    const double about = coin() ? uniform(0, 6.3) : small_or_none();
    if (kind < 1) {
      const double from = log_uniform(-9, 0);
      return {std::cos(from), std::sin(from) * std::sin(about), std::sin(from) * std::cos(about)};
    }
    if (kind < 2) {
      const double along = tilt * uniform(-1, 1);
      const double across = coin() ? uniform(-1, 1) : small_or_none();
      return Vec3(along, across, 1 - std::abs(across)).normalized();
    }
    return Vec3(uniform(-1, 1), uniform(-1, 1), uniform(0, 1)).normalized();
  }

  std::mt19937_64 random_;
};

/// Centres so far apart that their difference overflows, and sizes so large that bodies may overlap
/// all the same.
void move_to_the_limit(RawConfiguration& c) {
  constexpr double max_length = std::numeric_limits<double>::max();
  double largest = 0;
  for (const double x : c.sizes) largest = std::max(largest, x);
  if (!(largest > 0)) return;
  for (double& x : c.sizes) {
    if (x > 0) x = std::clamp(x / largest * max_length, 1.0, max_length);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = std::copysign(1, c.position_a[i]);
    const double part = std::abs(std::remainder(c.position_a[i], 1));
    c.position_a[i] = side * (0.5 + part) * max_length;
    c.position_b[i] = -side * (0.5 + part / 2) * max_length;
  }
}

}  // namespace

Case without_truth(int pair, std::uint64_t index) {
  constexpr int cylinders = 3;
  if (pair == cylinders && index % 4 == 0) {
    return {"rims/" + std::to_string(index), raw(MeetingRims(index).make()), 0, {}, {}};
  }
  const Identity id{static_cast<Pair>(pair), "hostile", case_seed + 1, index};
  Case result{to_string(id), raw(make_configuration(id)), 0, {}, {}};
  if (index % 64 == 1) {
    move_to_the_limit(result.raw);
    result.identity += "/limit";
  }
  return result;
}

}  // namespace touchstone::mutation
