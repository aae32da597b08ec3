#pragma once

#include <random>

#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// Bodies and poses of small integers and halves, with integer quaternions: a large part of them
/// is degenerate in some way, and exact in double.
class LatticePoses {
 public:
  explicit LatticePoses(unsigned seed) : random_(seed) {}

  double integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random_); }
  double length() { return integer(1, 4) / 2; }
  Eigen::Quaterniond orientation() {
    for (;;) {
      const Eigen::Quaterniond q(integer(-2, 2), integer(-2, 2), integer(-2, 2), integer(-2, 2));
      if (q.squaredNorm() > 0) return q;
    }
  }
  Vec3 position() { return {integer(-4, 4) / 2, integer(-4, 4) / 2, integer(-4, 4) / 2}; }
  Cylinder cylinder() { return {length(), length()}; }
  Shape other_body(int kind) {
    switch (kind % 4) {
      case 0:
        return Sphere(length());
      case 1:
        return Capsule(length(), length());
      case 2:
        return cylinder();
      default:
        return Box({length(), length(), length()});
    }
  }
  Configuration next() {
    const Shape b = other_body(kind_++);
    return {cylinder(), Pose(position(), orientation()), b, Pose(Vec3::Zero(), orientation())};
  }

 private:
  std::mt19937 random_;
  int kind_ = 0;
};

}  // namespace touchstone::oracle
