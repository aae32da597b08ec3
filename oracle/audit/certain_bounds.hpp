#pragma once

#include <array>
#include <cmath>

#include "oracle/audit/bodies.hpp"

namespace touchstone::audit {

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

template <class T>
bool certainly_contain(const Bodies<T>& bodies, const PointPair<Real<T>>& pair) {
  return certainly_contains(bodies.a, pair.a) && certainly_contains(bodies.b, pair.b);
}

/// Certain lower bound of g(n/|n|).
template <class T>
Real<T> gap_below(const Bodies<T>& bodies, const Vector<Real<T>>& n) {
  using std::sqrt;
  const Vector<T> exact = as<T>(n);
  return lower(T(gap_times_length(bodies, exact) / T(sqrt(T(exact.squaredNorm())))));
}

template <class T>
Vector<T> exact_difference(const Bodies<T>& bodies, const PointPair<Real<T>>& pair) {
  return difference(bodies, PointPair<T>{as<T>(pair.a), as<T>(pair.b)});
}

/// Certain upper bound of the points' distance, and so of the gap along every direction.
template <class T>
Real<T> distance_above(const Bodies<T>& bodies, const PointPair<Real<T>>& pair) {
  using std::sqrt;
  const Vector<T> w = exact_difference(bodies, pair);
  return upper(T(sqrt(T(w.squaredNorm()))));
}

/// Certain upper bound of w·m/|m| over the cell's corners m, with w = a − b. If it is negative it
/// bounds the gap along all directions of the cell: for hi <= 0, w·m − hi |m| is convex in m, so
/// that w·m <= hi |m| holds between the corners, too.
template <class T>
Real<T> corner_bound_above(const Bodies<T>& bodies, const PointPair<Real<T>>& pair,
                           const DirectionCell<Real<T>>& cell) {
  using std::sqrt;
  const Vector<T> w = exact_difference(bodies, pair);
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
