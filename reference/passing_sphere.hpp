#pragma once

#include <algorithm>
#include <cmath>

#include "largest_gap.hpp"
#include "pose.hpp"
#include "shape.hpp"

namespace touchstone {

/// When a sphere meets a cylinder that moves, by closed forms whose rounding nothing bounds: it
/// tells where to ask for the distance, and which sweeps clearly meet nothing.
///
/// In the cylinder's frame the sphere's centre moves along a line. Until it enters the cylinder
/// that is wider and longer by the sphere's radius, the bodies are apart. Where it enters that
/// beside A's cap or side, they touch; elsewhere they do when it comes as near to A's rim.
class PassingSphere {
 public:
  /// `offset` is A's position from the sphere's, and `sweep` how far A moves while t goes from 0 to
  /// 1; metres, world.
  PassingSphere(const Cylinder& a, const Pose& pose_a, const Vec3& offset, const Vec3& sweep,
                const Sphere& b)
      : from_(-(pose_a.rotation().transpose() * offset)),
        way_(-(pose_a.rotation().transpose() * sweep)),
        radius_(a.positive_core_radius()),
        half_length_(a.positive_core_half_length()),
        reach_(a.rounding() + b.radius()) {
    constexpr double max_length = 1e100;  // squares are finite
    const double lengths = from_.cwiseAbs().sum() + way_.cwiseAbs().sum() + radius_ + half_length_;
    if (!(lengths + reach_ < max_length)) return;
    const double across = from_.head<2>().norm();
    const double beyond_cap = std::abs(from_.z()) - half_length_ - reach_;
    const double beyond_side = across - radius_ - reach_;
    if (beyond_cap > 0) enter_slab(beyond_cap);
    if (beyond_side > 0) enter_sides(beyond_side, across + radius_ + reach_);
    constexpr double clearly_later = 1 + 1e-6;  // roots of nearly equal zeros have half the digits
    misses_ = misses_ || time_ > clearly_later;
    if (!misses_) approach_rim(), approach_rim();
  }

  /// Is the sphere clearly apart from A during the whole sweep?
  bool misses() const { return misses_; }
  /// Where the distance, above zero at the start, is likely to be zero; not above zero where
  /// nothing is known.
  double time() const { return time_; }

 private:
  void enter_slab(double height) {
    const double speed = from_.z() > 0 ? -way_.z() : way_.z();
    misses_ = !(speed > 0);
    time_ = height / speed;
  }
  /// The product of the two lengths is the difference of their squares.
  void enter_sides(double height, double sum) {
    const double slope = from_.head<2>().dot(way_.head<2>());
    const double product = way_.head<2>().squaredNorm() * (height * sum);
    const double under_root = slope * slope - product;
    misses_ = misses_ || slope >= 0 || under_root < -rounding_part * product;
    time_ = std::max(time_, height * sum / (std::sqrt(std::max(under_root, 0.0)) - slope));
  }
  /// Towards the zero of the squared distance to the rim less the squared reach, by the parabola
  /// that it has most in common with: two steps leave next to nothing.
  void approach_rim() {
    const Vec3 there = from_ + time_ * way_;
    const double rho = there.head<2>().norm();
    const double beyond_side = rho - radius_, beyond_cap = std::abs(there.z()) - half_length_;
    if (!(beyond_side > 0 && beyond_cap > 0)) return;
    const double away = there.head<2>().dot(way_.head<2>()) / rho;
    const double up = there.z() > 0 ? way_.z() : -way_.z();
    const double height = beyond_side * beyond_side + beyond_cap * beyond_cap - reach_ * reach_;
    const double slope = beyond_side * away + beyond_cap * up;
    const double turning = beyond_side * (way_.head<2>().squaredNorm() - away * away) / rho;
    const double curvature = away * away + up * up + turning;
    const double under_root = slope * slope - curvature * height;
    if (slope < 0) time_ += height / (std::sqrt(std::max(under_root, 0.0)) - slope);
  }

  Vec3 from_, way_;  ///< of the sphere's centre, along A's axes
  double radius_, half_length_, reach_;
  double time_ = 0;
  bool misses_ = false;
};

}  // namespace touchstone
