#pragma once

#include <algorithm>
#include <cmath>

#include "oracle/audit/arithmetic.hpp"
#include "reference/configuration.hpp"

namespace touchstone::audit {

// A configuration in an arithmetic of choice: enclosed by intervals, exact in rationals, rounded in
// doubles. Every shape but the half-space is the sum of a box, a disc across the local z axis and a
// ball, any of which may be a point; a cylinder is a segment plus a disc.

template <class T>
struct Body {
  Matrix<T> axes;  ///< Columns: the body's axes in world coordinates, orthonormal.
  Vector<T> half_extents = Vector<T>(T(0), T(0), T(0));
  T disc_radius{0}, ball_radius{0};
};

template <class T>
struct Bodies {
  Body<T> a, b;
  Vector<T> offset;  ///< Centre A − centre B, world coordinates.
};

/// A point of A and a point of B, each in its own body frame. Their difference w = a − b bounds the
/// gap along every unit vector: g(n) <= w·n.
template <class T>
struct PointPair {
  Vector<T> a, b;
};

/// The rotation of a quaternion of any length, R(q)/|q|², by Euler–Rodrigues.
template <class T>
Matrix<T> rotation(const Eigen::Quaterniond& quaternion) {
  // A power of two first, so that no square overflows; it cancels.
  const T scale(std::ldexp(1.0, std::ilogb(quaternion.coeffs().cwiseAbs().maxCoeff())));
  const T w = T(quaternion.w()) / scale, x = T(quaternion.x()) / scale;
  const T y = T(quaternion.y()) / scale, z = T(quaternion.z()) / scale;
  const T two(2);
  Matrix<T> r;
  r << w * w + x * x - y * y - z * z, two * (x * y - w * z), two * (x * z + w * y),
      two * (x * y + w * z), w * w - x * x + y * y - z * z, two * (y * z - w * x),
      two * (x * z - w * y), two * (y * z + w * x), w * w - x * x - y * y + z * z;
  const T squared = w * w + x * x + y * y + z * z;
  for (int i = 0; i < 9; ++i) r(i) = r(i) / squared;
  return r;
}

/// Sets the sizes of a body from its shape, in multiples of a unit; nothing for a half-space.
template <class T>
struct Sizes {
  Body<T>& body;
  T unit;

  void operator()(const Cylinder& s) const {
    body.half_extents.z() = T(s.half_length()) / unit;
    body.disc_radius = T(s.radius()) / unit;
  }
  void operator()(const Capsule& s) const {
    body.half_extents.z() = T(s.half_length()) / unit;
    body.ball_radius = T(s.radius()) / unit;
  }
  void operator()(const Sphere& s) const { body.ball_radius = T(s.radius()) / unit; }
  void operator()(const Box& s) const {
    for (int i = 0; i < 3; ++i) body.half_extents[i] = T(s.half_extents()[i]) / unit;
  }
  void operator()(const Plane&) const {}
};

/// Lengths in multiples of `unit`, a power of two in metres.
template <class T>
Bodies<T> make_bodies(const Configuration& c, double unit) {
  Bodies<T> bodies;
  bodies.a.axes = rotation<T>(c.pose_a.orientation());
  bodies.b.axes = rotation<T>(c.pose_b.orientation());
  Sizes<T>{bodies.a, T(unit)}(c.a);
  std::visit(Sizes<T>{bodies.b, T(unit)}, c.b);
  // Quarters: the difference of two doubles may not be one.
  for (int i = 0; i < 3; ++i) {
    bodies.offset[i] =
        (T(c.pose_a.position()[i]) / T(4) - T(c.pose_b.position()[i]) / T(4)) / (T(unit) / T(4));
  }
  return bodies;
}

/// Support of a body about its centre: max over its points p of p·n, n in its frame.
template <class T>
T support(const Body<T>& body, const Vector<T>& n) {
  using std::abs, std::sqrt;
  T sum(0);
  for (int i = 0; i < 3; ++i) sum += body.half_extents[i] * T(abs(n[i]));
  const T across = n.x() * n.x() + n.y() * n.y();
  sum += body.disc_radius * T(sqrt(across));
  sum += body.ball_radius * T(sqrt(T(across + n.z() * n.z())));
  return sum;
}

/// The difference a − b of a pair, world coordinates.
template <class T>
Vector<T> difference(const Bodies<T>& bodies, const PointPair<T>& pair) {
  const Vector<T> a = bodies.a.axes * pair.a, b = bodies.b.axes * pair.b;
  return bodies.offset + a - b;
}

/// g(n) |n| for a world vector n of any length.
template <class T>
T gap_times_length(const Bodies<T>& bodies, const Vector<T>& n) {
  const Vector<T> n_a = bodies.a.axes.transpose() * n, n_b = bodies.b.axes.transpose() * n;
  return bodies.offset.dot(n) - support(bodies.a, n_a) - support(bodies.b, n_b);
}

}  // namespace touchstone::audit
