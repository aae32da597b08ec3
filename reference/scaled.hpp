#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact.hpp"
#include "pose.hpp"
#include "shape.hpp"

namespace touchstone {

// Lengths so large or small that their squares overflow or vanish are brought into range by a power
// of two, which rounds nothing, and the answer back. Nobody simulates such bodies, but a body that
// has flown off must be answered with a number, not with NaN.

// Largest powers are the eighth (`ellipse_normal` and `towards` take lengths of fourth powers):
// with all lengths within these bounds none leaves 1e-200 to 1e200, whichever lengths it
// multiplies.
inline constexpr double least_length = 1e-25, most_length = 1e25;

/// The smallest of a body's lengths, and their sum with the offsets.
struct Lengths {
  double least, sum;
};
inline Lengths lengths(double x, double y) { return {std::min(x, y), x + y}; }
inline Lengths lengths(const Sphere& s) { return {s.radius(), s.radius()}; }
inline Lengths lengths(const Cylinder& s) { return lengths(s.radius(), s.half_length()); }
inline Lengths lengths(const Capsule& s) { return lengths(s.radius(), s.half_length()); }
inline Lengths lengths(const Box& s) {
  const Vec3& e = s.half_extents();
  return {std::min({e.x(), e.y(), e.z()}), e.x() + e.y() + e.z()};
}
inline Lengths lengths(const Plane& s) { return {most_length, std::abs(s.unit_displacement())}; }

/// Are all lengths such that their eighth powers are ordinary doubles?
template <class Other>
bool ordinary(const Cylinder& a, const Pose& pose_a, const Other& b, const Pose& pose_b) {
  const Lengths of_a = lengths(a), of_b = lengths(b);
  const Vec3 d = pose_a.position() - pose_b.position();
  return std::min(of_a.least, of_b.least) > least_length && of_a.sum + of_b.sum < most_length &&
         d.x() * d.x() + d.y() * d.y() + d.z() * d.z() < most_length * most_length;
}

/// The bodies about B's centre, with all lengths times a power of two so that the largest is about
/// one; lengths that vanish against it are made 1e-24 of it.
template <class Other>
class ScaledBodies {
 public:
  ScaledBodies(const Cylinder& a, const Pose& pose_a, const Other& b, const Pose& pose_b)
      : origin_(pose_b.position()),
        exponent_(std::ilogb(
            std::max({largest(a), largest(b), largest(Vec3(pose_a.position() - origin_))}))),
        a_(scaled(a)),
        b_(scaled(b)),
        pose_a_(scaled_difference(pose_a.position()), pose_a.orientation()),
        pose_b_(Vec3::Zero(), pose_b.orientation()) {}

  /// Calls question(a, pose_a, b, pose_b) for the scaled bodies.
  template <class Question>
  auto ask(Question question) const {
    return question(a_, pose_a_, b_, pose_b_);
  }
  double scaled(double length) const { return std::scalbn(length, -exponent_); }

  /// The answers in the world's lengths; what overflows is the largest double.
  SignedDistance back(SignedDistance answer) const {
    answer.value = back(answer.value);
    return answer;
  }
  CertifiedDistance back(CertifiedDistance answer) const {
    answer.value = back(answer.value);
    answer.error_bound = back(answer.error_bound + vanishing);
    return answer;
  }
  Contact back(const Contact& answer) const {
    Contact result;
    result.normal = answer.normal;
    result.signed_distance = back(answer.signed_distance);
    for (const ContactPoint& p : answer.points()) {
      const Vec3 arm = p.position.unaryExpr([&](double x) { return back(x); });
      result.add_point((origin_ + arm).cwiseMax(-max_length).cwiseMin(max_length), back(p.depth));
    }
    return result;
  }

 private:
  static constexpr double vanishing = 1e-24;

  static constexpr double max_length = std::numeric_limits<double>::max();

  static double largest(const Vec3& x) { return std::min(x.cwiseAbs().maxCoeff(), max_length); }
  template <class Body>
  static double largest(const Body& s) {
    // A capsule's two lengths may only overflow when they are added.
    return std::min(largest_half_extent(s), max_length);
  }
  static double largest(const Plane& s) { return std::abs(s.unit_displacement()); }
  double size(double length) const { return std::max(scaled(length), vanishing); }
  Plane scaled(const Plane& s) const {
    return Plane(s.unit_normal(), scaled(s.unit_displacement()));
  }
  Sphere scaled(const Sphere& s) const { return Sphere(size(s.radius())); }
  Cylinder scaled(const Cylinder& s) const { return {size(s.radius()), size(s.half_length())}; }
  Capsule scaled(const Capsule& s) const { return {size(s.radius()), size(s.half_length())}; }
  Box scaled(const Box& s) const {
    const Vec3& e = s.half_extents();
    return Box(Vec3(size(e.x()), size(e.y()), size(e.z())));
  }
  /// The position less the origin; a difference that overflows is scaled before it is taken.
  Vec3 scaled_difference(const Vec3& position) const {
    const Vec3 difference = position - origin_;
    if (difference.allFinite()) return difference.unaryExpr([&](double x) { return scaled(x); });
    return position.unaryExpr([&](double x) { return scaled(x); }) -
           origin_.unaryExpr([&](double x) { return scaled(x); });
  }
  double back(double length) const {
    return std::clamp(std::scalbn(length, exponent_), -max_length, max_length);
  }

  Vec3 origin_;
  int exponent_;
  Cylinder a_;
  Other b_;
  Pose pose_a_, pose_b_;
};

}  // namespace touchstone
