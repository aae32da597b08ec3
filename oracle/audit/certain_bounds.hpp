#pragma once

#include <CGAL/Interval_nt.h>
#include <algorithm>
#include <array>
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reference/configuration.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::audit {

/// Double intervals that round outward while a Protect_FPU_rounding<true> is alive: their
/// enclosures are certain. Brönnimann, Burnikel, Pion, "Interval arithmetic yields efficient
/// dynamic filters for computational geometry", Discrete Applied Mathematics 109, 2001.
using Interval = CGAL::Interval_nt<false>;

/// Floating point of about 400 bits, for searches in which doubles are too coarse.
using Multiprecision = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<120, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

template <class T>
using Vector = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix = Eigen::Matrix<T, 3, 3>;

/// The search's numbers that belong to an arithmetic T of certain results: points, cells and
/// directions are computed in them without any guarantee.
template <class T>
struct SearchNumber {
  using type = T;
};
template <>
struct SearchNumber<Interval> {
  using type = double;
};
template <class T>
using Real = typename SearchNumber<T>::type;

/// Certain lower (upper) bound of a value in T. For all types but intervals: the value itself.
template <class T>
const T& lower(const T& x) {
  return x;
}
template <class T>
const T& upper(const T& x) {
  return x;
}
inline double lower(const Interval& x) { return x.inf(); }
inline double upper(const Interval& x) { return x.sup(); }

/// Converts a vector to another arithmetic; exact if that one is finer.
template <class To, class From>
Vector<To> as(const Vector<From>& v) {
  return {To(v.x()), To(v.y()), To(v.z())};
}

/// The larger of two numbers, certainly.
template <class T>
T larger(const T& x, const T& y) {
  return x < y ? y : x;
}
inline Interval larger(const Interval& x, const Interval& y) {
  return {std::max(x.inf(), y.inf()), std::max(x.sup(), y.sup())};
}

// A configuration in any arithmetic: enclosed in intervals, exact in rationals, rounded in doubles.
// Every shape but the half-space and the hull is the Minkowski sum of a box, a disc perpendicular
// to the local z axis and a ball, any of which may be a point; a cylinder is a segment plus a disc.
// Rounded bodies are their cores: balls added to two bodies take their radii from the gap along
// every direction, and so from the signed distance.

template <class T>
struct Body {
  Matrix<T> axes;  ///< columns: the body's axes in world coordinates, orthonormal
  Vector<T> half_extents = Vector<T>(T(0), T(0), T(0));
  T disc_radius{0}, ball_radius{0};
  std::vector<Vector<T>> vertices;  ///< of a hull, which has none of the others
};

template <class T>
struct Bodies {
  Body<T> a, b;
  Vector<T> offset;  ///< centre A − centre B, world coordinates
  T rounding{0};     ///< of both together: the signed distance is that of these less it
};

/// A share of one of a hull's vertices in a point.
template <class T>
struct VertexWeight {
  int vertex;
  T weight;
};

/// A point of A and a point of B, each in its own body frame. Their difference w = a − b bounds the
/// gap along every unit vector: g(n) <= w·n.
template <class T>
struct PointPair {
  Vector<T> a, b;
  /// In a hull, instead of `b`: the point is the mean of vertices by their weights, of any sum. Who
  /// sees that none is negative need not know the hull's faces.
  std::vector<VertexWeight<T>> weights = {};
};

template <class To, class From>
PointPair<To> as(const PointPair<From>& pair) {
  PointPair<To> result{as<To>(pair.a), as<To>(pair.b)};
  for (const auto& [vertex, weight] : pair.weights) result.weights.push_back({vertex, To(weight)});
  return result;
}

/// The rotation of a quaternion of any length, R(q)/|q|², by Euler–Rodrigues.
template <class T>
Matrix<T> rotation(const Eigen::Quaterniond& quaternion) {
  // Divide by a power of two, which cancels, so that no square overflows.
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

/// Where a body's frame has its origin, for numbers of the body's size: a hull may be far from its
/// position.
inline Vec3 centre(const Shape& shape) {
  const auto* hull = std::get_if<Convex>(&shape);
  return hull ? hull->middle() : Vec3(Vec3::Zero());
}

/// Sets a body's sizes from its shape, in multiples of a unit; a half-space has none.
template <class T>
struct Sizes {
  Body<T>& body;
  T unit;

  void operator()(const Cylinder& s) const {
    body.half_extents.z() = of_core(s.half_length(), s.rounding());
    body.disc_radius = of_core(s.radius(), s.rounding());
  }
  void operator()(const Capsule& s) const {
    body.half_extents.z() = T(s.half_length()) / unit;
    body.ball_radius = T(s.radius()) / unit;
  }
  void operator()(const Sphere& s) const { body.ball_radius = T(s.radius()) / unit; }
  void operator()(const Box& s) const {
    for (int i = 0; i < 3; ++i) body.half_extents[i] = of_core(s.half_extents()[i], s.rounding());
  }
  void operator()(const Convex& s) const {
    const Vector<T> middle = as<T>(s.middle()) / unit;
    for (const Vec3& v : s.vertices()) body.vertices.push_back(as<T>(v) / unit - middle);
  }
  void operator()(const Plane&) const {}

  /// Rounded down, as the lower end of an interval, where doubles round up, as they do beside
  /// intervals.
  T of_core(double size, double rounding) const { return T(-(T(rounding) - T(size))) / unit; }
};

/// A power of two near the configuration's largest length, metres. Lengths in multiples of it do
/// not overflow.
inline double unit_of(const Configuration& c) {
  const Vec3 middle = centre(c.b);
  const Vec3 quarter_apart =
      c.pose_a.position() / 4 - c.pose_b.position() / 4 - c.pose_b.rotation() * (middle / 4);
  // 2^-60 of it is what 400 bits leave of a hull that is far from its position.
  double length = std::max({larger_size(c), quarter_apart.cwiseAbs().maxCoeff(),
                            std::ldexp(middle.cwiseAbs().maxCoeff(), -60)});
  if (const auto* plane = std::get_if<Plane>(&c.b)) {
    const double offset = plane->displacement() / plane->normal().cwiseAbs().maxCoeff();
    length = std::max(length, std::abs(offset));
  }
  return std::ldexp(1.0, std::clamp(std::ilogb(length), -1000, 1000));
}

/// Throws InvalidInput unless the width is positive and finite.
inline void check_width(double width) {
  if (std::isfinite(width) && width > 0) return;
  throw InvalidInput("width", std::to_string(width), "must be positive and finite");
}

/// Converts a configuration, with lengths in multiples of `unit`, a power of two in metres.
template <class T>
Bodies<T> make_bodies(const Configuration& c, double unit) {
  Bodies<T> bodies;
  bodies.a.axes = rotation<T>(c.pose_a.orientation());
  bodies.b.axes = rotation<T>(c.pose_b.orientation());
  Sizes<T>{bodies.a, T(unit)}(c.a);
  std::visit(Sizes<T>{bodies.b, T(unit)}, c.b);
  bodies.rounding = (T(c.a.rounding()) + T(rounding_of(c.b))) / T(unit);
  // Quarters, because the difference of two doubles may overflow.
  for (int i = 0; i < 3; ++i) {
    bodies.offset[i] =
        (T(c.pose_a.position()[i]) / T(4) - T(c.pose_b.position()[i]) / T(4)) / (T(unit) / T(4));
  }
  if (!bodies.b.vertices.empty()) {
    bodies.offset -= bodies.b.axes * Vector<T>(as<T>(centre(c.b)) / T(unit));
  }
  return bodies;
}

/// Support of a body about its centre: max of p·n over its points p, with n in the body's frame.
template <class T>
T support(const Body<T>& body, const Vector<T>& n) {
  using std::abs, std::sqrt;
  if (!body.vertices.empty()) {
    T highest = body.vertices[0].dot(n);
    for (const Vector<T>& v : body.vertices) highest = larger(highest, T(v.dot(n)));
    return highest;
  }
  T sum(0);
  for (int i = 0; i < 3; ++i) sum += body.half_extents[i] * T(abs(n[i]));
  const T across = n.x() * n.x() + n.y() * n.y();
  sum += body.disc_radius * T(sqrt(across));
  sum += body.ball_radius * T(sqrt(T(across + n.z() * n.z())));
  return sum;
}

/// The point of B, in its frame.
template <class T>
Vector<T> point_of_b(const Bodies<T>& bodies, const PointPair<T>& pair) {
  if (pair.weights.empty()) return pair.b;
  T sum(0);
  Vector<T> weighted(T(0), T(0), T(0));
  for (const auto& [vertex, weight] : pair.weights) {
    sum += weight;
    weighted += weight * bodies.b.vertices[vertex];
  }
  return weighted / sum;
}

/// The difference a − b of a pair of points, world coordinates.
template <class T>
Vector<T> difference(const Bodies<T>& bodies, const PointPair<T>& pair) {
  const Vector<T> a = bodies.a.axes * pair.a, b = bodies.b.axes * point_of_b(bodies, pair);
  return bodies.offset + a - b;
}

/// g(n) |n| for a world vector n of any length.
template <class T>
T gap_times_length(const Bodies<T>& bodies, const Vector<T>& n) {
  const Vector<T> n_a = bodies.a.axes.transpose() * n, n_b = bodies.b.axes.transpose() * n;
  return bodies.offset.dot(n) - support(bodies.a, n_a) - support(bodies.b, n_b);
}

/// The directions through a dyadic square on a face of the cube [−1, 1]³. All coordinates are exact
/// in R as long as the level is below its number of bits.
template <class R>
struct DirectionCell {
  int face;   ///< 2 k for the face where coordinate k is +1, 2 k + 1 where it is −1.
  int level;  ///< 0: the whole face.
  R u, v;     ///< Lowest corner in coordinates k + 1 and k + 2 (cyclically).
  R size;     ///< Side: 2^(1 − level).

  Vector<R> at(const R& x, const R& y) const {
    const int k = face / 2;
    Vector<R> m;
    m[k] = R(face % 2 == 0 ? 1 : -1);
    m[(k + 1) % 3] = x;
    m[(k + 2) % 3] = y;
    return m;
  }
  Vector<R> centre() const { return at(u + size / 2, v + size / 2); }

  /// The vectors that span the cell's cone; they lie on the cube and are not unit.
  std::array<Vector<R>, 4> corners() const {
    return {at(u, v), at(u + size, v), at(u, v + size), at(u + size, v + size)};
  }

  /// Quarter 0 to 3: bit 0 is the upper half in u, bit 1 in v.
  DirectionCell child(int quarter) const {
    const R half = size / 2;
    return {face, level + 1, quarter & 1 ? R(u + half) : u, quarter & 2 ? R(v + half) : v, half};
  }

  static DirectionCell whole_face(int face) { return {face, 0, R(-1), R(-1), R(2)}; }
};

// The functions on which a result rests. T is an arithmetic with certain results; points, cells and
// directions are given in the search's numbers and taken as exact.

template <class R>
bool is_finite(const Vector<R>& v) {
  return v - v == Vector<R>(Vector<R>::Zero());
}

/// Is p (body frame) certainly in the body?
template <class T>
bool certainly_contains(const Body<T>& body, const Vector<Real<T>>& p) {
  if (!is_finite(p)) return false;
  // p is a point of the box plus a remainder, which must lie in the sum of disc and ball.
  T squared(0);
  for (int i = 0; i < 3; ++i) {
    const Real<T> h = lower(body.half_extents[i]);
    if (p[i] <= h && p[i] >= -h) continue;
    if (i == 2 && !(lower(body.ball_radius) > 0)) return false;
    const T rest = p[i] > 0 ? T(T(p[i]) - T(h)) : T(T(p[i]) + T(h));
    squared += rest * rest;
  }
  const Real<T> radius = lower(T(body.disc_radius + body.ball_radius));
  const T limit = T(radius) * T(radius);
  return upper(squared) <= lower(limit);
}

/// Do the weights certainly have a mean?
template <class R>
bool are_shares(const std::vector<VertexWeight<R>>& weights) {
  R sum(0);
  for (const auto& [vertex, weight] : weights) {
    if (!(weight >= 0)) return false;
    sum += weight;
  }
  return sum > 0 && sum - sum == 0;
}

template <class T>
bool certainly_contain(const Bodies<T>& bodies, const PointPair<Real<T>>& pair) {
  return certainly_contains(bodies.a, pair.a) &&
         (bodies.b.vertices.empty() ? certainly_contains(bodies.b, pair.b)
                                    : are_shares(pair.weights));
}

/// Certain lower bound of g(n/|n|).
template <class T>
Real<T> gap_below(const Bodies<T>& bodies, const Vector<Real<T>>& n) {
  using std::sqrt;
  const Vector<T> exact = as<T>(n);
  return lower(T(gap_times_length(bodies, exact) / T(sqrt(T(exact.squaredNorm())))));
}

/// Certain upper bound of the points' distance, and so of the gap along every direction.
template <class T>
Real<T> distance_above(const Bodies<T>& bodies, const PointPair<Real<T>>& pair) {
  using std::sqrt;
  const Vector<T> w = difference(bodies, as<T>(pair));
  return upper(T(sqrt(T(w.squaredNorm()))));
}

/// Certain upper bound of w·m/|m| over the cell's corners m, with w = a − b. If it is negative it
/// bounds the gap along all directions of the cell: for hi <= 0, w·m − hi |m| is convex in m, so
/// that w·m <= hi |m| holds between the corners, too.
template <class T>
Real<T> corner_bound_above(const Bodies<T>& bodies, const PointPair<Real<T>>& pair,
                           const DirectionCell<Real<T>>& cell) {
  using std::sqrt;
  const Vector<T> w = difference(bodies, as<T>(pair));
  bool first = true;
  Real<T> bound(0);
  for (const auto& corner : cell.corners()) {
    const Vector<T> m = as<T>(corner);
    const Real<T> value = upper(T(w.dot(m) / T(sqrt(T(m.squaredNorm())))));
    if (first || !(value <= bound)) bound = value;
    first = false;
  }
  return bound;
}

}  // namespace touchstone::audit
