#pragma once

#include <cmath>

#include "oracle/audit/bodies.hpp"
#include "oracle/audit/direction_cell.hpp"

namespace touchstone::audit {

// Everything that a result rests on. T is an arithmetic whose results are certain; points, cells
// and directions are given in the search's numbers and taken as exact.

template <class R>
bool is_finite(const Vector<R>& v) {
  return v - v == Vector<R>(Vector<R>::Zero());
}

/// Is p (body frame) certainly a point of the body?
template <class T>
bool certainly_contains(const Body<T>& body, const Vector<Real<T>>& p) {
  if (!is_finite(p)) return false;
  // p = (a point of the box) + (a rest, which the disc and the ball must hold).
  T squared(0);
  for (int i = 0; i < 3; ++i) {
    const Real<T> h = lower(body.half_extents[i]);
    if (p[i] <= h && p[i] >= -h) continue;
    if (i == 2 && !(lower(body.ball_radius) > 0)) return false;
    const T rest = p[i] > 0 ? T(T(p[i]) - T(h)) : T(T(p[i]) + T(h));
    squared += rest * rest;
  }
  const Real<T> radius = lower(T(body.disc_radius + body.ball_radius));
  const T most = T(radius) * T(radius);
  return upper(squared) <= lower(most);
}

template <class T>
bool certainly_contain(const Bodies<T>& bodies, const PointPair<Real<T>>& pair) {
  return certainly_contains(bodies.a, pair.a) && certainly_contains(bodies.b, pair.b);
}

/// g(n/|n|) is not below this.
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

/// The points' distance is not above this. It is a bound of the gap along every direction.
template <class T>
Real<T> distance_above(const Bodies<T>& bodies, const PointPair<Real<T>>& pair) {
  using std::sqrt;
  const Vector<T> w = exact_difference(bodies, pair);
  return upper(T(sqrt(T(w.squaredNorm()))));
}

/// With w = a − b: the largest w·m/|m| over the cell's corners m is not above this. Where it is
/// negative it bounds the gap along all directions of the cell, for w·m <= hi |m| at the corners
/// holds in between as well: w·m − hi |m| is convex in m if hi <= 0.
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
