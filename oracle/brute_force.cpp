#include "oracle/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "reference/support.hpp"

namespace touchstone::oracle {
namespace {

/// The gap g(n), independent of reference/support: the textbook support functions, with the
/// rotations computed once. Positions are subtracted first.
class Gap {
 public:
  explicit Gap(const Configuration& c)
      : a_(c.a),
        b_(c.b),
        to_a_(c.pose_a.rotation().transpose()),
        to_b_(c.pose_b.rotation().transpose()),
        d_(c.pose_a.position() - c.pose_b.position()) {}

  double operator()(const Vec3& n) const {
    return d_.dot(n) - cylinder(a_, to_a_ * n) - other(to_b_ * n);
  }

 private:
  static double cylinder(const Cylinder& s, const Vec3& n) {
    return s.half_length() * std::abs(n.z()) +
           s.radius() * std::sqrt(n.x() * n.x() + n.y() * n.y());
  }
  double other(const Vec3& n) const {
    if (const auto* s = std::get_if<Sphere>(&b_)) return s->radius();
    if (const auto* s = std::get_if<Capsule>(&b_)) {
      return s->half_length() * std::abs(n.z()) + s->radius();
    }
    if (const auto* s = std::get_if<Cylinder>(&b_)) return cylinder(*s, n);
    if (const auto* s = std::get_if<Box>(&b_)) return s->half_extents().dot(n.cwiseAbs());
    throw std::logic_error("a half-space has no finite gap but along its normal");
  }

  Cylinder a_;
  Shape b_;
  Eigen::Matrix3d to_a_, to_b_;
  Vec3 d_;
};

/// Moves to the best of eight neighbours at an angle of about `step`, which is halved if none is
/// better. The number of steps is bounded because a climb along a ridge can take millions.
BruteForce climb(const Gap& gap, BruteForce best, double step) {
  for (int count = 0; count < 400 && step > 1e-9; ++count) {
    const Vec3 e = best.normal.unitOrthogonal(), f = best.normal.cross(e);
    BruteForce better = best;
    for (int k = 0; k < 8; ++k) {
      const double angle = k * std::numbers::pi / 4;
      const Vec3 n =
          (best.normal + step * (std::cos(angle) * e + std::sin(angle) * f)).normalized();
      const double g = gap(n);
      if (g > better.gap) better = {g, n};
    }
    if (better.gap > best.gap) {
      best = better;
    } else {
      step /= 2;
    }
  }
  return best;
}

}  // namespace

BruteForce brute_force_maximum(const Configuration& configuration, int directions) {
  const Gap gap(configuration);
  std::vector<BruteForce> all;
  all.reserve(static_cast<std::size_t>(directions));
  // Fibonacci lattice.
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2 * i + 1.0) / directions;
    const double radius = std::sqrt(1 - z * z);
    const Vec3 n(radius * std::cos(i * turn), radius * std::sin(i * turn), z);
    all.push_back({gap(n), n});
  }
  constexpr std::ptrdiff_t starts = 6;
  std::partial_sort(all.begin(), all.begin() + starts, all.end(),
                    [](const auto& x, const auto& y) { return x.gap > y.gap; });
  const double spacing = 4 / std::sqrt(directions);
  BruteForce best = all.front();
  for (std::ptrdiff_t i = 0; i < starts; ++i) {
    const BruteForce found = climb(gap, all[static_cast<std::size_t>(i)], spacing);
    if (found.gap > best.gap) best = found;
  }
  return best;
}

double lowest_point_over_plane(const Configuration& c) {
  const auto& plane = std::get<Plane>(c.b);
  const Eigen::Matrix3d rotation_a = c.pose_a.rotation();
  const Vec3 normal = c.pose_b.rotation() * plane.normal();
  const Vec3 centre = c.pose_a.position() - c.pose_b.position();
  const auto height = [&](double angle, double z) {
    const Vec3 on_rim(c.a.radius() * std::cos(angle), c.a.radius() * std::sin(angle), z);
    return (normal.dot(rotation_a * on_rim) + (normal.dot(centre) - plane.displacement())) /
           normal.norm();
  };
  double lowest = std::numeric_limits<double>::infinity();
  for (const double z : {-c.a.half_length(), c.a.half_length()}) {
    constexpr int count = 64;
    double best = 0;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      if (height(angle, z) < height(best, z)) best = angle;
    }
    for (double step = 0.1; step > 1e-9; step /= 2) {
      for (const double angle : {best - step, best + step}) {
        if (height(angle, z) < height(best, z)) best = angle;
      }
    }
    lowest = std::min(lowest, height(best, z));
  }
  return lowest;
}

void expect_brute_force_agrees(const Configuration& c, const Truth& t, int directions) {
  // Rounding of g in double: a few ulp of the lengths that enter it.
  const double lengths = larger_size(c) + (c.pose_a.position() - c.pose_b.position()).norm();
  const double rounding = 1e-14 * lengths;
  const double sigma = t.signed_distance.midpoint();
  EXPECT_LE(t.signed_distance.width(), 1e-15 * larger_size(c));
  ASSERT_FALSE(t.normals.empty());
  for (const OptimalNormal& normal : t.normals) {
    EXPECT_NEAR(touchstone::gap(c, normal.n), sigma, rounding) << "normal " << normal.n.transpose();
  }
  const BruteForce found = brute_force_maximum(c, directions);
  EXPECT_LE(found.gap, sigma + rounding) << "along " << found.normal.transpose();
}

}  // namespace touchstone::oracle
