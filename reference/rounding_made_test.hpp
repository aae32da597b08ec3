#pragma once

#include <cmath>
#include <cstdint>

#include "reference/random_bodies_test.hpp"

namespace touchstone {

/// Random pairs of cylinders as rounding makes them, and others that attack one early exit of the
/// search each (proofs.md, "Where a search ends early"). Each index has its own configuration.
class RoundingMade : private Random {
 public:
  explicit RoundingMade(std::uint64_t index) : Random(index) {}

  /// Bodies whose axes are parallel, opposite or across each other, and whose caps and sides lie
  /// within each other, flush, touching, or beyond, in every combination: also beyond both. The
  /// whole is turned at random, and then the orientation and position of each body are rounded by
  /// themselves, as a simulation leaves them.
  Configuration arrangement() {
    const Cylinder a(size(), size()), b = toss() ? a : Cylinder(size(), size());
    const bool crosses = one_of(6) == 0;
    const double along_b = crosses ? b.radius() : b.half_length();
    const double along = place(a.half_length(), along_b), across = place(a.radius(), b.radius());
    const double heading = uniform(0, 6.3);
    const Vec3 d(across * std::cos(heading), across * std::sin(heading), sign() * along);
    const Quaternion relation = crosses ? Quaternion(1, 1, 0, 0) : Quaternion(1, 0, 0, 0);
    const Quaternion frame = turn();
    return {a, Pose(worn(Vec3(frame * d)), worn(frame)), b,
            Pose(Vec3::Zero(), worn(frame * relation.normalized()))};
  }

  /// Diagonally above each other, beyond both cap and side, with axes that are parallel but for
  /// what rounding leaves, which leans A's lower cap towards B.
  Configuration diagonal() {
    const Cylinder a(uniform(0.2, 2), uniform(0.2, 2)), b(uniform(0.2, 2), uniform(0.2, 2));
    const double across = a.radius() + b.radius() + uniform(0, 0.05);
    const double along = a.half_length() + b.half_length() + uniform(0, 1);
    const double heading = uniform(0, 6.3), towards = heading + uniform(-0.3, 0.3);
    const double half = power_of_ten(-15.5, -13);
    const Quaternion frame = turn();
    const Quaternion lean(1, -half * std::sin(towards), half * std::cos(towards), 0);
    const Vec3 d(across * std::cos(heading), across * std::sin(heading), along);
    return {a, Pose(frame * d, frame * lean), b, Pose(Vec3::Zero(), frame)};
  }

  /// A post lies with its axis in a coin's cap and along its rim, which it touches next to its end:
  /// seen along the post, the coin is a segment that ends there.
  Configuration post_along_rim() {
    const Cylinder coin(uniform(1, 5), uniform(0.2, 1)), post(uniform(0.05, 0.3), uniform(1, 4));
    const auto ulp = [&] { return toss() ? sign() * power_of_ten(-17, -15) : 0; };
    const double end = post.half_length() + sign() * power_of_ten(-6, -2);
    const Vec3 d(coin.radius() + ulp(), sign() * end, coin.half_length() + ulp());
    const Quaternion lying = Quaternion(1, ulp(), 0, 0) * Quaternion(1, -1, 0, 0).normalized();
    const Quaternion spin(1, 0, 0, toss() ? power_of_ten(-16, -9) : 0);
    return {post, Pose(d, lying), coin, Pose(Vec3::Zero(), spin)};
  }

  /// Two equal coins of 1:10^4 to 1:10^9 stand across each other, each with its centre on the
  /// other's rim: along a curve of normals the gap is minus the radius but for 1e-8 of it.
  Configuration equal_coins() {
    const double r = uniform(0.2, 1), h1 = r * power_of_ten(-9, -4);
    const double h2 = toss() ? h1 : r * power_of_ten(-9, -4);
    const auto hair = [&] { return toss() ? 0 : sign() * r * power_of_ten(-12, -5); };
    const Vec3 d(sign() * h1 + hair(), r + hair(), sign() * h2 + hair());
    return turned(Cylinder(r, h1), d, across_by(power_of_ten(-5, -3)), Cylinder(r, h2));
  }

  /// A needle, far thinner than the disc under it, hangs over its rim by a hair.
  Configuration needle_over_rim() {
    const Cylinder disc(1, power_of_ten(-3, -1)),
        needle(power_of_ten(-5, -3), power_of_ten(-2, -0.5));
    const double end = toss() ? 0 : sign() * power_of_ten(-12, -8);
    const Vec3 d(sign() * needle.half_length() * (1 + end), 1 + power_of_ten(-9, -3),
                 disc.half_length() + needle.radius() + power_of_ten(-3, -1));
    return turned(needle, d, across_by(power_of_ten(-10, -7)), disc);
  }

  /// Two coins whose axes are all but perpendicular, one nearly its radius deep in the other, so
  /// that the rims meet along a normal next to an axis: there one rim turns back close to the
  /// other's axis (proofs.md, "The search of rims"). Aspects are 1:10^4 to 1:10^8, angles 1e-8 to
  /// 1e-4.
  Configuration deep_coins() {
    const double r1 = uniform(0.2, 1), r2 = toss() ? r1 : uniform(0.2, 1);
    const double h1 = r1 * power_of_ten(-8, -4), h2 = r2 * power_of_ten(-8, -4);
    const double c = toss() ? 0 : power_of_ten(-17, -6);
    const double from_axis = power_of_ten(-8, -4), about = power_of_ten(-7, -2);
    const Vec3 u1(1, 0, 0), u2(c, std::sqrt((1 - c) * (1 + c)), 0);
    const Vec3 n(std::cos(from_axis), std::sin(from_axis) * std::sin(about),
                 std::sin(from_axis) * std::cos(about));
    const Vec3 across1 = n - n.dot(u1) * u1, across2 = n - n.dot(u2) * u2;
    const double depth = r2 * across2.norm() * (1 - power_of_ten(-7, -2));
    const Vec3 rims = r1 * across1.normalized() + r2 * across2.normalized() - depth * n;
    const Vec3 d = rims + std::copysign(h1, n.dot(u1)) * u1 + std::copysign(h2, n.dot(u2)) * u2;
    const auto along = [](const Vec3& axis) { return turn_between(Vec3::UnitZ(), axis); };
    const Quaternion frame = turn();
    return {Cylinder(r1, h1), Pose(frame * d, frame * along(u1)), Cylinder(r2, h2),
            Pose(Vec3::Zero(), frame * along(u2))};
  }

 private:
  using Quaternion = Eigen::Quaterniond;

  double size() { return toss() ? uniform(0.2, 2) : std::exp2(one_of(5) - 2); }

  /// How far two features are from each other that reach by x and y from their centres.
  double place(double x, double y) {
    switch (one_of(6)) {
      case 0:
        return 0;
      case 1:
        return uniform(0, 1) * (x + y);
      case 2:
        return std::abs(x - y);
      default:
        return x + y + clearance();
    }
  }
  double clearance() {
    switch (one_of(5)) {
      case 0:
        return uniform(0, 2);
      case 1:
      case 4:
        return uniform(-0.02, 0.05);
      case 2:
        return sign() * power_of_ten(-16, -3);
      default:
        return 0;
    }
  }

  /// What is left of an orientation after turns that cancel, after small steps there and back, or
  /// after a shove of rounding's own size.
  Quaternion worn(Quaternion q) {
    switch (one_of(5)) {
      case 0: {
        const Quaternion there = turn();
        const int times = 1 + one_of(4);
        for (int i = 0; i < times; ++i) q = (there * q).normalized();
        for (int i = 0; i < times; ++i) q = (there.conjugate() * q).normalized();
        return q;
      }
      case 1: {
        const Vec3 w = 0.01 * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        const int steps = 1 + one_of(60);
        for (const double way : {1.0, -1.0}) {
          const Quaternion step = Quaternion(1, way * w.x(), way * w.y(), way * w.z()).normalized();
          for (int i = 0; i < steps; ++i) q = (step * q).normalized();
        }
        return q;
      }
      case 2:
      case 3: {
        const double size = power_of_ten(-16, -13.5);
        return q * Quaternion(1, size * uniform(-1, 1), size * uniform(-1, 1), 0);
      }
      default:
        return q;
    }
  }
  Vec3 worn(const Vec3& x) {
    const Vec3 shift(uniform(-3, 3), uniform(-3, 3), uniform(-3, 3));
    return toss() ? x : Vec3((x + shift) - shift);
  }

  /// Turns z so that this is the cosine of its angle with the old one.
  static Quaternion across_by(double cosine) {
    return Quaternion(Eigen::AngleAxisd(std::acos(cosine), Vec3::UnitY()));
  }
  /// A at d with an axis that is turned, B at the origin with its own along z; turned as one.
  Configuration turned(const Cylinder& a, const Vec3& d, const Quaternion& relation,
                       const Cylinder& b) {
    const Quaternion frame = turn();
    return {a, Pose(frame * d, frame * relation), b, Pose(Vec3::Zero(), frame)};
  }
};

}  // namespace touchstone
