#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "box_sides.hpp"
#include "curves.hpp"
#include "deep_normals.hpp"
#include "pair.hpp"

// In the box's frame the largest gap lies at one normal of six kinds:
//
//   face, cap, edge  a face; a cap; where an edge crosses the side (box_sides.hpp): mostly the best
//                    of these is proven
//   side_and_vertex  across the axis: a vertex beside the side
//   rim_and_edge     across an edge: it crosses a rim, which is a point against an ellipse, seen
//                    along the edge; of edges and rims the likely one is tried first, and mostly
//                    proves itself
//   rim_and_vertex   neither, only apart: a vertex off a rim
//
// Each stage has nothing to say where it is clear that its gap is not above the best one so far.

namespace touchstone {
namespace {

using Frame = CylinderInBoxFrame;

Vec3 vertex(const Frame& p, int i) {
  return {(i & 1) ? p.e[0] : -p.e[0], (i & 2) ? p.e[1] : -p.e[1], (i & 4) ? p.e[2] : -p.e[2]};
}

// Inlined: of eight vertices most are soon ruled out, and returning that costs as much.
[[gnu::always_inline]] inline StageResult side_and_vertex(const Frame& p, const Vec3& v,
                                                          double best) {
  const Vec3 arm = p.d - v;
  const double height = arm.dot(p.u);
  const Vec3 across = arm - height * p.u;
  const double squared = across.squaredNorm(), bound = best + p.r;
  if (!(squared > 0) || (bound > 0 && squared <= bound * bound)) return {};
  // Along an edge that is parallel to the axis, what is across is rounding of either sign.
  const double noise = -1e-15 * (p.d.cwiseAbs().sum() + p.e.sum());
  if ((v.cwiseProduct(across).array() < noise * p.e.array()).any()) return {};
  // What rounding leaves along the axis counts over its whole length.
  const double radial = std::sqrt(squared);
  Vec3 n = across / radial;
  n -= n.dot(p.u) * p.u;
  const double length = n.norm();
  if (!(length > 0.5)) return {};  // the vertex is on the axis, but for rounding
  n /= length;
  const bool pointed = (v.cwiseProduct(n).array() >= 0).all();
  const double gap = pointed ? radial - p.r : p.gap(n);
  return {gap, n.x(), n.y(), n.z(),
          pointed && std::abs(height) <= p.h - depth(gap) && depth(gap) <= p.r};
}
StageResult side_and_any_vertex(const Frame& p, double best) {
  StageResult found;
  for (int i = 0; i < 8; ++i) {
    found.improve(side_and_vertex(p, vertex(p, i), std::max(best, found.gap)));
  }
  return found;
}
/// Seen along the axis the box is a polygon, and where one of its corners is the nearest to the
/// axis, one of the two sides there is the furthest away: a corner's clearance times the cosine of
/// the angle to it is that of a side there, and no other side has a smaller angle.
StageResult side_and_nearest_vertex(const Frame& p, const BestEdge& edge, double best) {
  // Sides of about one direction, or of no length, cannot be told apart.
  constexpr double flat = 0.01;
  const bool is_pierced = !(edge.gap + p.r > 0);  // the axis passes through the polygon
  if (!(p.u.cwiseAbs().minCoeff() > flat)) {
    // Then no normal across the axis has a larger gap than -r.
    return is_pierced && best >= -p.r ? StageResult{} : side_and_any_vertex(p, best);
  }
  if (is_pierced) return {};
  const EdgeCrossing c = crossing(edge, p);
  if (std::abs(c.along_edge) <= p.e[edge.axis]) return {};
  return side_and_vertex(p, c.corner, best);
}

/// The edge along axis i at a corner of the box as seen along it, with these signs, and the rim at
/// an end, +1 or -1 along the axis.
struct EdgeAndRim {
  int i;
  double sign_j, sign_k, end;
};

/// What is seen along edge i: the axis's direction, unit, and the cylinder's half along it.
struct SeenAlong {
  Vec2 axis, lean;
  SeenAlong(const Frame& p, int i) {
    const double j = p.u[(i + 1) % 3], k = p.u[(i + 2) % 3];
    axis = Vec2(j / p.s[i], k / p.s[i]);
    lean = Vec2(p.h * j, p.h * k);
  }
};

/// Proofs for a normal at which a rim and an edge meet: of `bends_away`, near the axis with the
/// thickest cylinder in the box that stands on the face there. `nu` is n·u, `squared` 1 − nu²,
/// `slope` the gap's derivative across the edge.
bool is_proven_at_rim(const Frame& p, const EdgeAndRim& at, const Vec3& n, double nu,
                      double squared, double gap, double slope) {
  const int i = at.i, j = (i + 1) % 3, k = (i + 2) % 3;
  const double where = p.d[i] - at.end * p.h * p.u[i] + p.r * nu * p.u[i] / std::sqrt(squared);
  const double beyond = p.e[i] - std::abs(where);
  if (!(beyond > 0)) return false;
  if (is_met_by_points(gap, slope, proof_part * p.lengths())) return true;
  const double squared_sine = p.u[i] * p.u[i] / squared;
  const Rim rim{p.r, p.h}, edge{2 * beyond, std::min(p.e[j], p.e[k])};
  if (bends_away(rim, edge, squared_sine, depth(gap), slope)) return true;
  const int axis = std::abs(n[j]) > std::abs(n[k]) ? j : k, other = 3 - i - axis;
  const double radius = std::min(p.e[i], p.e[other]);
  Vec3 arm = p.d;
  for (const int x : {i, other}) {
    arm[x] -= std::clamp(p.d[x], radius - p.e[x], p.e[x] - radius);
  }
  const double along = arm.dot(p.u), lean = std::max(std::sqrt(squared), std::abs(n[other]));
  return along * nu >= 0 &&
         bends_away_near_axis(rim, edge, lean, squared_sine, depth(gap), slope,
                              {p.r, p.h, radius, p.e[axis], std::abs(p.u[axis]), p.s[axis],
                               std::abs(along), (arm - along * p.u).norm()});
}

/// By how much another normal along which this corner and this rim face each other may be better
/// than the best of all that were tried. The corner's normals, between those of two faces, are an
/// arc of the rim's.
double missed_beside_corner(const Frame& p, const EdgeAndRim& at, const Vec2& axis, double aside,
                            double ahead, const std::optional<Vec2>& foot, double best) {
  const double b = p.r * std::abs(p.u[at.i]);
  if (is_beyond_evolute(p.r, b, std::abs(aside), ahead)) return 0;
  const double side = std::copysign(1, aside);
  // How far a normal (x, y) of the rim's quadrant points outward along j, and along k: its product
  // with these.
  const Vec2 out_j = at.sign_j * Vec2(-side * axis.y(), at.end * axis.x());
  const Vec2 out_k = at.sign_k * Vec2(side * axis.x(), at.end * axis.y());
  NormalArc arc;
  for (const Vec2& out : {out_j, out_k}) {
    if (out.x() >= 0 && out.y() >= 0) continue;
    if (!(out.x() > 0 || out.y() > 0)) return 0;
    const Vec2 end(std::abs(out.y()), std::abs(out.x()));
    if (out.y() > 0 && cross2(arc.first, end) > 0) arc.first = end;
    if (out.x() > 0 && !(arc.last && cross2(*arc.last, end) > 0)) arc.last = end;
  }
  if (arc.last && cross2(arc.first, *arc.last) < 0) return 0;
  return ellipse_excess(p.r, b, std::abs(aside), ahead, foot, -best, arc);
}

/// The corner lies at q from the middle of the rim. `highest`, where it is asked for, is raised to
/// a bound of the gaps of all normals along which both face each other.
StageResult rim_and_edge(const Frame& p, const EdgeAndRim& at, const Vec2& axis, const Vec2& q,
                         double best, double* highest = nullptr) {
  const int i = at.i, j = (i + 1) % 3, k = (i + 2) % 3;
  const double b = p.r * std::abs(p.u[i]), aside = cross2(axis, q), ahead = at.end * axis.dot(q);
  const auto foot = ellipse_normal(p.r, b, std::abs(aside), ahead);
  if (highest && !foot) {
    *highest =
        std::max(*highest, best + missed_beside_corner(p, at, axis, aside, ahead, foot, best));
  }
  if (!foot) return {};
  const double x = foot->x(), y = foot->y(), across = std::copysign(x, aside);
  const double along = at.end * y;
  const double nj = along * axis.x() - across * axis.y();
  const double nk = along * axis.y() + across * axis.x();
  const double reach = std::sqrt(p.r * p.r * x * x + b * b * y * y);
  const double gap = p.d[j] * nj + p.d[k] * nk - p.e[j] * std::abs(nj) - p.e[k] * std::abs(nk) -
                     p.h * p.s[i] * y - reach;
  if (highest) {
    const double tried = std::max(gap, best);
    *highest =
        std::max(*highest, tried + missed_beside_corner(p, at, axis, aside, ahead, foot, tried));
  }
  if (!(gap > best)) return {};
  Vec3 n;
  n[i] = 0, n[j] = nj, n[k] = nk;
  StageResult found{gap, n.x(), n.y(), n.z()};
  if (!highest && nj * at.sign_j >= 0 && nk * at.sign_k >= 0) {
    const double slope =
        std::abs(x * ahead - y * std::abs(aside) + (p.r - b) * (p.r + b) * x * y / reach);
    found.is_proven = is_proven_at_rim(p, at, n, at.end * p.s[i] * y,
                                       x * x + p.u[i] * p.u[i] * y * y, gap, slope);
  }
  return found;
}

/// Seen along the edge, the sum of box and axis is a polygon; on each of its corners sits the cap's
/// ellipse, with half axes r across the axis and r |u_i| along it.
StageResult rim_and_edge_along(const Frame& p, int i, double best, double* highest) {
  if (!(p.s[i] > 0)) return {};
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const SeenAlong seen(p, i);
  const Vec2& axis = seen.axis;
  const Vec2 across = turned_left(axis), d(p.d[j], p.d[k]), e(p.e[j], p.e[k]);
  const double b = p.r * std::abs(p.u[i]);
  // Inside the polygon, no direction is better than its edges less the ellipse's inscribed disc.
  const double polygon = std::max(
      {std::abs(d.x()) - e.x() - p.h * std::abs(p.u[j]),
       std::abs(d.y()) - e.y() - p.h * std::abs(p.u[k]),
       std::abs(across.dot(d)) - e.x() * std::abs(across.x()) - e.y() * std::abs(across.y())});
  if (polygon <= 0 && polygon - b <= best) return {};
  StageResult found;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1);
    const Vec2 to_corner = d - sign.cwiseProduct(e);
    for (const double end : {1.0, -1.0}) {
      const Vec2 q = to_corner - end * seen.lean;
      const double least = std::max(best, found.gap), bound = least + b;
      // n points away from the corner, so that only what of q does so counts.
      const Vec2 out = q.cwiseProduct(sign).cwiseMax(0.0);
      if (bound >= 0 && out.squaredNorm() <= bound * bound) continue;
      // The corner's quadrant of normals and the ellipse's must overlap.
      const double aside = across.dot(q);
      if (!((std::copysign(1, aside) * across + end * axis).dot(sign) > 0)) continue;
      if (is_behind_chords(p.r, b, std::abs(aside), end * axis.dot(q), depth(least))) continue;
      found.improve(rim_and_edge(p, {i, sign.x(), sign.y(), end}, axis, q, least, highest));
    }
  }
  return found;
}

/// Where the best of the seven directions is not proven, because the point or the line at which the
/// bodies would meet lies beyond an edge or a rim.
StageResult likely_rim_and_edge(const Frame& p, const BoxSides& sides, double best) {
  using Kind = BoxSides::Kind;
  const Kind kind = sides.kind();
  constexpr double nearly_flat = 0.1;
  if (kind == Kind::cap && !(p.s[sides.face.axis] < nearly_flat)) return {};
  Vec3 sign;  // of a vertex
  EdgeAndRim at;
  if (kind != Kind::edge) {
    const int face = sides.face.axis, j = (face + 1) % 3, k = (face + 2) % 3;
    sign = point_facing(sides.face, p);
    at.i = std::abs(sign[j]) - p.e[j] > std::abs(sign[k]) - p.e[k] ? k : j;
    sign[face] = p.d[face];
    at.end = std::copysign(1, p.d[face] * p.u[face]);
  } else {
    const int edge = sides.edge.axis, j = (edge + 1) % 3, k = (edge + 2) % 3;
    const EdgeCrossing c = crossing(sides.edge, p);
    const double along = std::clamp(c.along_axis, -p.h, p.h);
    sign = c.corner;
    sign[edge] = p.d[edge] + along * p.u[edge];
    at.i = std::abs(sign[edge]) <= p.e[edge] ? edge : std::abs(p.u[k]) < std::abs(p.u[j]) ? j : k;
    at.end = -std::copysign(1, along);
  }
  // Along an edge across the axis the proof fails.
  constexpr double across = 1e-12;
  if (!(p.s[at.i] > 0 && std::abs(p.u[at.i]) > across)) return {};
  at.sign_j = std::copysign(1, sign[(at.i + 1) % 3]);
  at.sign_k = std::copysign(1, sign[(at.i + 2) % 3]);
  const SeenAlong seen(p, at.i);
  const int j = (at.i + 1) % 3, k = (at.i + 2) % 3;
  const Vec2 to_corner(p.d[j] - at.sign_j * p.e[j], p.d[k] - at.sign_k * p.e[k]);
  return rim_and_edge(p, at, seen.axis, to_corner - at.end * seen.lean, best);
}

/// Projects A's centre onto the box, that point onto A and that onto the box again (von Neumann's
/// alternating projections; more seldom help), and returns what is between the last two points:
/// zero where the bodies meet there.
Vec3 between_near_points(const Frame& p) {
  const auto onto_box = [&](const Vec3& x) -> Vec3 { return x.cwiseMax(-p.e).cwiseMin(p.e); };
  const Vec3 arm = p.d - onto_box(p.d);
  const double height = arm.dot(p.u);
  const Vec3 across = arm - height * p.u;
  const double squared = across.squaredNorm();
  const double scale = squared > p.r * p.r ? p.r / std::sqrt(squared) : 1;
  const Vec3 on_a = p.d - std::clamp(height, -p.h, p.h) * p.u - scale * across;
  return on_a - onto_box(on_a);
}
StageResult near_points(const Frame& p, const Vec3& between) {
  // These points may still be far from the nearest ones, but if they are close, so are the bodies.
  constexpr double small_part = 0.02;
  const double distance = between.norm();
  if (!(distance > small_part * p.r)) return {};
  const Vec3 n = (1 / distance) * between;
  return {p.gap(n), n.x(), n.y(), n.z()};
}

/// A vertex off the rim.
StageResult rim_and_this_vertex(const Frame& p, const Vec3& v) {
  const Vec3 arm = p.d - v;
  const double height = arm.dot(p.u);
  const Vec3 off_axis = arm - height * p.u;
  const double radial = off_axis.norm();
  // Computed anew, what was above or beside by rounding alone may not be so.
  const double above = std::max(std::abs(height) - p.h, 0.0);
  const double beside = std::max(radial - p.r, 0.0);
  if (!(above > 0 || beside > 0)) return {};
  Vec3 off_rim = std::copysign(above, height) * p.u;
  if (beside > 0) off_rim += (beside / radial) * off_axis;
  const Vec3 n = off_rim.normalized();
  if (!LargestGap::is_unit(n)) return {};
  return {p.gap(n), n.x(), n.y(), n.z()};
}
/// The nearest vertex that is off the rim, or all that are as near but for rounding.
StageResult rim_and_vertex(const Frame& p, bool all_nearest) {
  // Across the axis and along it, from the vertices to A's centre: the centre's part less that of
  // each half extent. (Squares that cancel would hide a thin body's radius.)
  const double along = p.d.dot(p.u);
  const Vec3 across = p.d - along * p.u;
  std::array<Vec3, 3> side;
  for (int i = 0; i < 3; ++i) side[i] = p.e[i] * (Vec3::Unit(i) - p.u[i] * p.u);
  constexpr double none = std::numeric_limits<double>::infinity();
  std::array<double, 8> squared;
  double nearest = none;
  int best = -1;
  for (int i = 0; i < 8; ++i) {  // branch-free: the winner is unpredictable
    const double x = (i & 1) ? 1 : -1, y = (i & 2) ? 1 : -1, z = (i & 4) ? 1 : -1;
    const double height = along - x * p.e[0] * p.u[0] - y * p.e[1] * p.u[1] - z * p.e[2] * p.u[2];
    const double radial = (across - x * side[0] - y * side[1] - z * side[2]).norm();
    const double above = std::abs(height) - p.h, beside = radial - p.r;
    const double distance = above * above + beside * beside;
    const bool is_off = (above > 0) & (beside > 0), better = is_off & (distance < nearest);
    squared[static_cast<std::size_t>(i)] = is_off ? distance : none;
    nearest = better ? distance : nearest;
    best = better ? i : best;
  }
  if (best < 0) return {};
  StageResult found = rim_and_this_vertex(p, vertex(p, best));
  if (!all_nearest) return found;
  const double as_near = std::sqrt(nearest) + rounding_part * p.lengths();
  for (int i = 0; i < 8; ++i) {
    if (i != best && squared[static_cast<std::size_t>(i)] <= as_near * as_near) {
      found.improve(rim_and_this_vertex(p, vertex(p, i)));
    }
  }
  return found;
}

StageResult largest_gap(const Frame& p, EarlyExit exit, double* highest) {
  const BoxSides sides(p);
  StageResult best = sides.best(p, exit.stop_above);
  if (exit.ends_with(best)) return best;
  // As deep in each other as this, bodies hardly ever come free where a rim meets an edge.
  constexpr double deep = 0.3;
  const auto try_likely = [&] {
    if (depth(best.gap) < deep * (std::min(p.r, p.h) + p.e.minCoeff())) {
      StageResult likely = likely_rim_and_edge(p, sides, best.gap);
      likely.is_proven = likely.is_proven && exit.trusts_proofs;  // its slope is rounded
      best.improve(likely);
    }
  };
  // A body that stands over an edge of a face comes free there sooner than at a vertex.
  const bool stands = sides.kind() != BoxSides::Kind::edge;
  if (stands) {
    try_likely();
    if (exit.ends_with(best)) return best;
  }
  best.improve(exit.trusts_proofs ? side_and_nearest_vertex(p, sides.edge, best.gap)
                                  : side_and_any_vertex(p, best.gap));
  if (exit.ends_with(best)) return best;
  if (!stands) {
    try_likely();
    if (exit.ends_with(best)) return best;
  }
  const Vec3 between = between_near_points(p);
  best.improve(near_points(p, between));
  if (exit.ends_with(best)) return best;
  if (!exit.trusts_proofs || !between.isZero(0))
    best.improve(rim_and_vertex(p, highest != nullptr));
  for (int i = 0; i < 3 && !exit.ends_with(best); ++i) {
    best.improve(rim_and_edge_along(p, i, best.gap, best.is_proven ? nullptr : highest));
  }
  return best;
}

CertifiedDistance find_largest(const PosedCylinder& a, const PosedBox& b, EarlyExit exit) {
  const Frame p(a.radius, a.half_length, b.half_extents, b.axes.transpose() * (a.centre - b.centre),
                b.axes.transpose() * a.axis());
  double highest = -std::numeric_limits<double>::infinity();
  const StageResult best = largest_gap(p, exit, exit.trusts_proofs ? nullptr : &highest);
  // The axis as seen by the box is not of unit length.
  const double missed = std::max(0.0, highest - best.gap) +
                        (exit.trusts_proofs ? 0 : std::abs(p.u.squaredNorm() - 1) * p.lengths());
  return {{best.gap, b.axes * best.normal()}, missed};
}

using BoxRoutine = SearchRoutine<PosedBox, find_largest>;

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                               const Pose& pose_b) {
  return find_signed_distance<BoxRoutine>(a, pose_a, b, pose_b);
}
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                                     const Pose& pose_b) {
  return find_certified_distance<BoxRoutine>(a, pose_a, b, pose_b);
}
bool overlaps(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b) {
  return find_overlap<BoxRoutine>(a, pose_a, b, pose_b);
}
Contact contact(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal, PointRange range) {
  return find_contact<BoxRoutine>(a, pose_a, b, pose_b, contact_threshold, previous_normal, range);
}

}  // namespace touchstone
