#pragma once

#include <cmath>

#include "oracle/audit/bodies.hpp"
#include "oracle/audit/direction_cell.hpp"

namespace touchstone::audit {

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
