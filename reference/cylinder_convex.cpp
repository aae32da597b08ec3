#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "convex_proofs.hpp"
#include "curves.hpp"
#include "cylinder_segment.hpp"
#include "pair.hpp"

// In the hull's frame the largest gap lies at one normal of six kinds:
//
//   cap, face        of one of the bodies; often one of its points proves it
//   side_and_edge    across axis and edge
//   side_and_vertex  across the axis: a vertex beside the side
//   rim_and_vertex   neither, only apart: a vertex off a rim
//   rim_and_edge     across an edge: it crosses a rim, which is a point against an ellipse, seen
//                    along the edge
//
// A likely face comes first. Where A's point that faces it lies on it, that mostly proves it; where
// it lies beyond an edge, that edge is asked alone, as a segment (cylinder_segment.hpp): a hull has
// no larger gap than a part of it, so if all of it lies behind that edge along the segment's best
// normal, that is the hull's, too.
//
// Else caps and faces are tried, and of edges and vertices those that a point of A leaves open:
// with n between the normals n1 and n2 of an edge's faces, n = k1 n1 + k2 n2 with k1, k2 >= 0 and
// k1 + k2 >= 1, so that g(n) is no more than k1 s1 + k2 s2, the heights of the point above the
// faces; likewise at a vertex (proofs.md, "Convex bodies"). A point where A and B are deepest in
// each other is far below all other faces, and few edges are left.

namespace touchstone {
namespace {

using InHull = CylinderInHullFrame;

StageResult at(double gap, const Vec3& n, bool is_proven = false) {
  return {gap, n.x(), n.y(), n.z(), is_proven};
}
/// Of a normal for which a feature of the hull with this vertex promises more than the best gap:
/// what it promises, less by how much another vertex is farther.
StageResult tried(const InHull& p, const Vec3& n, double promised, const Vec3& vertex,
                  double best) {
  const double gap = promised - std::max(0.0, p.b.support(n) - vertex.dot(n));
  return gap > best ? at(gap, n) : StageResult{};
}

/// What is compared without its root is at least this part of what counts.
constexpr double less_a_hair = 1 - 1e-12;

/// The best normal so far, and where on the hull the bodies meet along it.
struct Best {
  StageResult found;
  Vec3 place = Vec3::Zero();

  void improve(const StageResult& later, const Vec3& there) {
    if (later.gap > found.gap) *this = {later, there};
  }
};

/// What was found along the normal of a cap or face, and the vertex or face of the hull there.
struct OfFeature {
  StageResult found;
  int feature = 0;
};
/// Is proven where the hull's vertex that faces the cap lies on it, its depth away from the rim:
/// the bodies are no nearer than that, and the ball of that depth about it is in A.
OfFeature cap(const InHull& p) {
  using Four = ConvexTables::Four;
  Four lowest = p.b.vertices.front().along(p.u), highest = lowest;
  for (std::size_t i = 1; i < p.b.vertices.size(); ++i) {
    const Four z = p.b.vertices[i].along(p.u);
    lowest = lowest.min(z), highest = highest.max(z);
  }
  const double low = lowest.minCoeff(), high = highest.maxCoeff(), centre = p.d.dot(p.u);
  const double above = centre - p.h - high, below = low - centre - p.h;
  const double side = std::copysign(1, above - below);
  const Vec3 n = side * p.u;
  const double gap = std::max(above, below), delta = depth(gap);
  const int vertex = p.b.first_at(n, above >= below ? high : -low);
  const Vec3 arm = p.b.vertex(vertex) - p.d, across = arm - arm.dot(p.u) * p.u;
  const double room = p.r - delta;
  const bool is_proven = (delta <= p.h) & (room >= 0) & (across.squaredNorm() <= room * room);
  return {at(gap, n, is_proven), vertex};
}

/// The best face, if it is better than that.
OfFeature face(const InHull& p, double best) {
  using Four = ConvexTables::Four;
  int found = -1;
  for (std::size_t i = 0; i < p.b.faces.size(); ++i) {
    const ConvexTables::Planes& faces = p.b.faces[i];
    const ConvexTables::Points& n = faces.normal;
    const Four beside_caps = faces.heights(p.d) - p.h * n.along(p.u).abs();
    if (beside_caps.maxCoeff() <= best) continue;
    const Four x = p.u.y() * n.z - p.u.z() * n.y, y = p.u.z() * n.x - p.u.x() * n.z;
    const Four z = p.u.x() * n.y - p.u.y() * n.x;
    const Four gaps = beside_caps - p.r * (x * x + y * y + z * z).sqrt();
    for (int k = 0; k < 4; ++k) {  // branch-free: the winner is unpredictable
      const bool is_better = gaps[k] > best;
      best = is_better ? gaps[k] : best;
      found = is_better ? 4 * static_cast<int>(i) + k : found;
    }
  }
  if (found < 0) return {};
  found = std::min(found, p.b.face_count - 1);
  return {at(best, p.b.face_normal(found)), found};
}

/// A face that is likely the best: with 1 - (cosine² + cosine⁴) / 2 for the sine no root is waited
/// for, nor, until the end, one of each four for another.
int likely_face(const InHull& p) {
  using Four = ConvexTables::Four;
  const double half = p.r / 2;
  const auto gaps = [&](std::size_t i) -> Four {  // and the radius, which counts in all alike
    const ConvexTables::Planes& faces = p.b.faces[i];
    const Four cosine = faces.normal.along(p.u), squared = cosine * cosine;
    return faces.heights(p.d) - p.h * cosine.abs() + squared * (half + half * squared);
  };
  Four best = gaps(0);
  std::array<int, 4> found{0, 1, 2, 3};
  for (std::size_t i = 1; i < p.b.faces.size(); ++i) {
    const Four others = gaps(i);
    for (int k = 0; k < 4; ++k) {  // branch-free: the winner is unpredictable
      found[k] = others[k] > best[k] ? 4 * static_cast<int>(i) + k : found[k];
    }
    best = best.max(others);
  }
  const int low = best[1] > best[0], high = 2 + (best[3] > best[2]);
  return std::min(best[high] > best[low] ? found[high] : found[low], p.b.face_count - 1);
}

/// An edge and the cylinder, seen along the edge: its axis is a line, each cap an ellipse.
struct SeenAlongEdge {
  const ConvexTables::Edge& edge;
  Vec3 arm;                ///< from the edge's first end to A's centre
  double cosine, sine;     ///< between axis and edge
  Vec3 ahead, aside;       ///< unit, across the edge: along the axis, and across both
  bool is_crossed = true;  ///< else the axis is parallel to the edge, but for rounding

  SeenAlongEdge(const InHull& p, const ConvexTables::Edge& e)
      : edge(e), arm(p.d - e.from), cosine(p.u.dot(e.along)) {
    const Vec3 across = p.u - cosine * e.along;
    sine = across.norm();
    ahead = across / sine;
    if (!(sine >= few_digits)) {  // what rounding leaves along the edge counts over its length
      ahead -= ahead.dot(e.along) * e.along;
      const double length = ahead.norm();
      is_crossed = length > 0.5;
      ahead /= length;
    }
    aside = e.along.cross(ahead);
  }
  /// Where the axis passes the edge: on itself from A's centre, on the edge from its first end.
  double on_axis() const { return -arm.dot(ahead) / sine; }
  double on_edge() const { return arm.dot(edge.along) + on_axis() * cosine; }
  Vec3 nearest_to_axis() const {
    return edge.from + std::clamp(on_edge(), 0.0, edge.length) * edge.along;
  }
};

/// Whether the side may cross an edge with a larger gap than the best one: across both, the normal
/// is between those of the edge's faces only if these point to either side along the axis.
bool may_cross_side(const InHull& p, const ConvexTables::Edge& e, double best) {
  constexpr double rounding = 1e-15;
  const double left = p.u.dot(p.b.face_normal(e.left)), right = p.u.dot(p.b.face_normal(e.right));
  if (std::min(left, right) > rounding || std::max(left, right) < -rounding) return false;
  const Vec3 across = e.along.cross(p.u);  // not of unit length: no root is needed
  // Of an axis nearly along the edge what rounding leaves is much of both sides.
  const double distance =
      std::copysign(1, across.dot(e.middle)) * across.dot(p.d - e.from) + proof_part * p.lengths;
  const double least = best + p.r;
  if (least <= 0) return true;
  return distance > 0 && distance * distance > least * least * across.squaredNorm() * less_a_hair;
}

StageResult side_and_edge(const InHull& p, const SeenAlongEdge& seen, double best) {
  if (!seen.is_crossed) return {};
  const double side = std::copysign(1, seen.aside.dot(seen.edge.middle));
  const double distance = side * seen.arm.dot(seen.aside);
  if (!(distance - p.r > best)) return {};
  return tried(p, side * seen.aside, distance - p.r, seen.edge.from, best);
}

/// Of a vertex of the hull, and the way to another one, which is nearer to A if n points along it.
StageResult side_or_rim_and_vertex(const InHull& p, const Vec3& v, const Vec3& to_other,
                                   double best) {
  const Vec3 arm = p.d - v;
  const double height = arm.dot(p.u), above = std::abs(height) - p.h;
  const Vec3 across = arm - height * p.u;
  const double squared = across.squaredNorm(), bound = best + p.r;
  const bool is_beside = squared > 0 && (bound <= 0 || squared > bound * bound);
  StageResult found;
  const double radial = is_beside || above > 0 ? std::sqrt(squared) : 0;
  const double rounding = proof_part * p.lengths * p.lengths;  // of the way along the axis
  if (is_beside && (radial - p.r - best) * radial > across.dot(to_other) - rounding) {
    Vec3 n = across / radial;
    n -= n.dot(p.u) * p.u;  // what rounding leaves along the axis counts over its whole length
    const double length = n.norm();
    if (length > 0.5) {  // else the vertex is on the axis, but for rounding
      found = tried(p, n / length, radial - p.r, v, best);
    }
  }
  if (!(above > 0)) return found;
  const double beside = radial - p.r;
  const double most = std::max(best, found.gap);
  if (!(beside > 0) || (most > 0 && above * above + beside * beside <= most * most)) return found;
  const Vec3 off = std::copysign(above, height) * p.u + (beside / radial) * across;
  const Vec3 n = off.normalized();
  if (LargestGap::is_unit(n)) {
    found.improve(tried(p, n, off.norm(), v, most));
  }
  return found;
}

/// By how much another normal along which this edge and a rim face each other may be better than
/// the best of all that were tried. The edge's normals are an arc of the rim's; `out1` and `out2`
/// are how a normal's parts aside and ahead count towards it from either face.
double missed_on_arc(double r, double b, double aside, double ahead,
                     const std::optional<Vec2>& foot, const Vec2& out1, const Vec2& out2,
                     double best) {
  if (is_beyond_evolute(r, b, aside, ahead)) return 0;
  NormalArc arc;
  for (const Vec2& out : {out1, out2}) {
    if (out.x() >= 0 && out.y() >= 0) continue;
    if (!(out.x() > 0 || out.y() > 0)) return 0;
    const Vec2 end(std::abs(out.y()), std::abs(out.x()));
    if (out.y() > 0 && cross2(arc.first, end) > 0) arc.first = end;
    if (out.x() > 0 && !(arc.last && cross2(*arc.last, end) > 0)) arc.last = end;
  }
  if (arc.last && cross2(arc.first, *arc.last) < 0) return 0;
  return ellipse_excess(r, b, aside, ahead, foot, -best, arc);
}

/// The rim of an end, +1 or -1 along the axis. `highest`, where it is asked for, is raised to a
/// bound of the gaps of all normals along which it and the edge face each other.
StageResult rim_and_edge(const InHull& p, const SeenAlongEdge& seen, double end, double best,
                         double* highest) {
  const double b = p.r * std::abs(seen.cosine);
  const double side = std::copysign(1, seen.arm.dot(seen.aside));
  const double beside = without_vanishing(side * seen.arm.dot(seen.aside));
  const double ahead = without_vanishing(end * seen.arm.dot(seen.ahead) - p.h * seen.sine);
  const double bound = best + b, out = std::max(ahead, 0.0);
  if (bound >= 0 && beside * beside + out * out <= bound * bound) return {};
  const Vec3 left = p.b.face_normal(seen.edge.left), right = p.b.face_normal(seen.edge.right);
  const auto points_to = [&](const Vec3& way) {
    return std::max({left.dot(way), seen.edge.middle.dot(way), right.dot(way)}) >= 0;
  };
  if (!points_to(side * seen.aside) || !points_to(end * seen.ahead)) return {};
  if (is_behind_chords(p.r, b, beside, ahead, depth(best))) return {};
  const auto foot = ellipse_normal(p.r, b, beside, ahead);
  StageResult found;
  if (foot) {
    const double x = foot->x(), y = foot->y();
    const double reach = std::sqrt(p.r * x * (p.r * x) + b * y * (b * y));
    const double promised = beside * x + ahead * y - reach;
    if (promised > best) {
      found =
          tried(p, end * y * seen.ahead + side * x * seen.aside, promised, seen.edge.from, best);
    }
  }
  if (!highest) return found;
  const Vec3 out1 = seen.edge.along.cross(left), out2 = right.cross(seen.edge.along);
  const auto seen_way = [&](const Vec3& way) {
    return Vec2(side * way.dot(seen.aside), end * way.dot(seen.ahead));
  };
  const double most = std::max(best, found.gap);
  *highest = std::max(*highest, most + missed_on_arc(p.r, b, beside, ahead, foot, seen_way(out1),
                                                     seen_way(out2), most));
  return found;
}
/// Both rims.
StageResult rims_and_edge(const InHull& p, const ConvexTables::Edge& e, double best,
                          double* highest) {
  const SeenAlongEdge seen(p, e);
  StageResult found;
  if (!seen.is_crossed) return found;
  for (const double end : {1.0, -1.0}) {
    found.improve(rim_and_edge(p, seen, end, std::max(best, found.gap), highest));
  }
  return found;
}

/// An edge alone, as a segment: its best normal is the hull's where the hull lies behind it.
struct EdgeAlone {
  const ConvexTables::Edge& edge;
  Vec3 n, end;  ///< of its ends the one that is farther along n
  StageResult found;

  EdgeAlone(const InHull& p, int index) : edge(p.b.edges[static_cast<std::size_t>(index)]) {
    const double half = edge.length / 2;
    const Vec3 middle = edge.from + half * edge.along, &to = p.b.vertex(edge.vertices[1]);
    const FoldedSegment segment{FoldedAxes(p.u, edge.along, p.d - middle), p.r, p.h, half};
    const StageResult of_edge = largest_gap(segment, {no_early_exit}, nullptr);
    n = segment.axes.to_world(of_edge.normal());
    end = n.dot(to) > n.dot(edge.from) ? to : edge.from;
    const double beyond = std::max(0.0, p.b.support(n) - n.dot(end));
    found = at(of_edge.gap - beyond, n, beyond <= tie_part * p.lengths);
  }
  /// An edge of the vertex that is farther than this one along n, which leads back here falling off
  /// least; -1 if there is none.
  int next(const InHull& p) const {
    const int vertex = p.b.farthest_vertex(n);
    const Vec3 way = end - p.b.vertex(vertex);
    int next = -1;
    double most = -std::numeric_limits<double>::infinity();
    for (const int i : p.b.vertex_edges.of(vertex)) {
      const ConvexTables::Edge& e = p.b.edges[static_cast<std::size_t>(i)];
      const double sign = e.vertices[0] == vertex ? 1 : -1, onward = sign * e.along.dot(way);
      const double rises = sign * e.along.dot(n);
      if (onward > 0 && rises > most * onward) most = rises / onward, next = i;
    }
    return next;
  }
};

/// Vertices that were tried, each once.
class Tried {
 public:
  explicit Tried(const InHull& p) { std::fill_n(bits_.begin(), p.b.vertices.size() / 16 + 1, 0); }
  bool is_new(int vertex) {
    std::uint64_t& bits = bits_[static_cast<std::size_t>(vertex) / 64];
    const std::uint64_t bit = std::uint64_t{1} << (vertex % 64);
    const bool result = (bits & bit) == 0;
    bits |= bit;
    return result;
  }

 private:
  std::array<std::uint64_t, Convex::max_vertices / 64 + 1> bits_;
};

/// Tries all that A's point where the bodies meet leaves open. Out of line: mostly it is not
/// needed.
[[gnu::noinline]] StageResult search_open_edges(const InHull& p, EarlyExit exit, Best best,
                                                double* highest) {
  const auto is_over = [&] { return exit.ends_with(best.found); };
  const auto open_edges = [&] {
    if (!exit.trusts_proofs) return OpenEdges(p);
    return OpenEdges(p, point_facing(p, best.found.normal(), best.place), best.found.gap);
  };
  Tried vertices(p);
  bool is_any = false;
  open_edges().visit([&](int edge, int, int) {
    is_any = true;
    const ConvexTables::Edge& e = p.b.edges[static_cast<std::size_t>(edge)];
    if (may_cross_side(p, e, best.found.gap)) {
      const SeenAlongEdge seen(p, e);
      best.improve(side_and_edge(p, seen, best.found.gap), seen.nearest_to_axis());
    }
    for (int end = 0; end < 2; ++end) {
      const int i = e.vertices[end];
      if (!vertices.is_new(i)) continue;
      const Vec3 &v = p.b.vertex(i), &other = p.b.vertex(e.vertices[1 - end]);
      best.improve(side_or_rim_and_vertex(p, v, other - v, best.found.gap), v);
    }
    return !is_over();
  });
  if (!is_any || is_over()) return best.found;
  // Here A's point that faces each face excludes most of its edges.
  const OpenEdges left = open_edges();
  int at_face = -1;
  std::optional<FacingPoint> x;
  left.visit([&](int edge, int face, int other) {
    const ConvexTables::Edge& e = p.b.edges[static_cast<std::size_t>(edge)];
    if (exit.trusts_proofs) {
      if (face != at_face) {
        at_face = face;
        x.emplace(p, face);
      }
      if (!left.leaves_open(e, *x, other)) return true;
      const double delta = depth(best.found.gap) + rounding_part * p.lengths;
      if (holds_ball(p, e.from, delta) || holds_ball(p, e.from + e.length * e.along, delta)) {
        return true;
      }
    }
    best.found.improve(rims_and_edge(p, e, best.found.gap, highest));
    return !is_over();
  });
  return best.found;
}

/// A face, where A's point that faces it lies on it; else the edge beyond which that lies, or next
/// to it the one to which a farther vertex leads.
Best likely_face_or_edge(const InHull& p, EarlyExit exit) {
  const int face = likely_face(p);
  const AtFace at_face(p, face);
  Best best{at(at_face.gap, at_face.n), p.b.face_middles[static_cast<std::size_t>(face)]};
  if (exit.ends_with(best.found)) return best;
  best.found.is_proven = at_face.is_proven(p);
  if (best.found.is_proven || !(at_face.beyond > 0)) return best;
  const EdgeAlone first(p, at_face.edge);
  best.improve(first.found, first.edge.from);
  if (exit.ends_with(best.found)) return best;
  if (const int next = first.next(p); next >= 0) {
    const EdgeAlone second(p, next);
    best.improve(second.found, second.edge.from);
  }
  return best;
}

StageResult largest_gap(const InHull& p, EarlyExit exit, double* highest) {
  Best best;
  if (exit.trusts_proofs) best = likely_face_or_edge(p, exit);
  if (exit.ends_with(best.found)) return best.found;
  const OfFeature of_cap = cap(p);
  best.improve(of_cap.found, p.b.vertex(of_cap.feature));
  if (exit.ends_with(best.found)) return best.found;
  const OfFeature of_face = face(p, best.found.gap);
  best.improve(of_face.found, p.b.face_middles[static_cast<std::size_t>(of_face.feature)]);
  if (exit.ends_with(best.found)) return best.found;
  return search_open_edges(p, exit, best, highest);
}

CertifiedDistance find_largest(const PosedCylinder& a, const PosedConvex& b, EarlyExit exit) {
  const ConvexTables& tables = b.body.tables();
  const Vec3 arm = a.centre - b.centre;
  const InHull p{tables,
                 a.radius,
                 a.half_length,
                 b.axes.transpose() * arm,
                 b.axes.transpose() * a.axis(),
                 arm.cwiseAbs().sum() + a.radius + a.half_length + tables.far};
  double highest = -std::numeric_limits<double>::infinity();
  const StageResult best = largest_gap(p, exit, exit.trusts_proofs ? nullptr : &highest);
  // The axis as seen by the hull is not of unit length.
  const double missed = std::max(0.0, highest - best.gap) +
                        (exit.trusts_proofs ? 0 : std::abs(p.u.squaredNorm() - 1) * p.lengths);
  return {{best.gap, b.axes * best.normal()}, missed};
}

using ConvexRoutine = SearchRoutine<PosedConvex, find_largest>;

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Convex& b,
                               const Pose& pose_b) {
  return find_signed_distance<ConvexRoutine>(a, pose_a, b, pose_b);
}
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Convex& b,
                                     const Pose& pose_b) {
  return find_certified_distance<ConvexRoutine>(a, pose_a, b, pose_b);
}
bool overlaps(const Cylinder& a, const Pose& pose_a, const Convex& b, const Pose& pose_b) {
  return find_overlap<ConvexRoutine>(a, pose_a, b, pose_b);
}
Contact contact(const Cylinder& a, const Pose& pose_a, const Convex& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal, PointRange range) {
  return find_contact<ConvexRoutine>(a, pose_a, b, pose_b, contact_threshold, previous_normal,
                                     range);
}

}  // namespace touchstone
