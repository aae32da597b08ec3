#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/audit/bodies.hpp"

namespace touchstone::audit {

// Points of bodies, in the search's rounding arithmetic. Nothing here needs to be right for a
// bound to hold: `certainly_contains` in certain_bounds.hpp judges every point that is used.

/// A point of the body, farthest along n (body frame, any length).
template <class R>
Vector<R> support_point(const Body<R>& body, const Vector<R>& n) {
  using std::sqrt;
  Vector<R> p;
  for (int i = 0; i < 3; ++i) p[i] = n[i] < 0 ? R(-body.half_extents[i]) : body.half_extents[i];
  const R across = sqrt(R(n.x() * n.x() + n.y() * n.y()));
  if (body.disc_radius > 0 && across > 0) {
    p.x() += body.disc_radius * n.x() / across;
    p.y() += body.disc_radius * n.y() / across;
  }
  const R length = sqrt(R(n.squaredNorm()));
  if (body.ball_radius > 0 && length > 0) p += n * R(body.ball_radius / length);
  return p;
}

/// The pair that decides the gap along n (world, any length): lowest of A, highest of B.
template <class R>
PointPair<R> support_pair(const Bodies<R>& bodies, const Vector<R>& n) {
  const Vector<R> n_a = bodies.a.axes.transpose() * n, n_b = bodies.b.axes.transpose() * n;
  return {support_point(bodies.a, Vector<R>(-n_a)), support_point(bodies.b, n_b)};
}

/// The point moved into the body by a little more than rounding can have moved it out.
template <class R>
Vector<R> pulled_inside(const Body<R>& body, const Vector<R>& p) {
  using std::abs, std::sqrt;
  Vector<R> core;
  for (int i = 0; i < 3; ++i) {
    const R& h = body.half_extents[i];
    core[i] = p[i] > h ? h : p[i] < -h ? R(-h) : p[i];
  }
  const R radius = body.disc_radius + body.ball_radius;
  Vector<R> round = p - core;
  if (body.ball_radius == 0) round.z() = 0;
  const R margin =
      R(16) * std::numeric_limits<R>::epsilon() * (radius + R(body.half_extents.maxCoeff()));
  const R length = sqrt(R(round.squaredNorm()));
  const R allowed = radius > margin ? R(radius - margin) : R(0);
  if (length > allowed) round *= R(allowed / length);
  return core + round;
}

template <class R>
PointPair<R> pulled_inside(const Bodies<R>& bodies, const PointPair<R>& pair) {
  return {pulled_inside(bodies.a, pair.a), pulled_inside(bodies.b, pair.b)};
}

}  // namespace touchstone::audit
