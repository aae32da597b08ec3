#include "oracle/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace touchstone::oracle {
namespace {

/// g(n) once more, independent of reference/support: by the support functions' textbook forms with
/// the rotations computed once. Positions are subtracted first.
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
    // A half-space has a finite support along its own normal only.
    return std::numeric_limits<double>::infinity();
  }

  Cylinder a_;
  Shape b_;
  Eigen::Matrix3d to_a_, to_b_;
  Vec3 d_;
};

/// Eight neighbours at an angle about `step`; halved when none is better. Counted, since a climb
/// along a ridge can take millions of steps.
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

}  // namespace touchstone::oracle
