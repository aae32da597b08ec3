#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "convex_tables.hpp"
#include "curves.hpp"
#include "deep_normals.hpp"
#include "pair.hpp"

// In the hull's frame the largest gap lies at one normal of six kinds, tried in this order:
//
//   cap, face        of one of the bodies; often one of its points proves it
//   side_and_edge    across axis and edge: mostly proven where they cross
//   side_and_vertex  across the axis: a vertex beside the side
//   rim_and_vertex   neither, only apart: a vertex off a rim
//   rim_and_edge     across an edge: it crosses a rim, which is a point against an ellipse, seen
//                    along the edge; of edges and rims the likely one is tried first, and mostly
//                    proves itself
//
// Faces are tried all. Of edges and vertices only those that a point of A leaves open: with n
// between the normals n1 and n2 of an edge's faces, n = k1 n1 + k2 n2 with k1, k2 >= 0 and
// k1 + k2 >= 1, so that g(n) is no more than k1 s1 + k2 s2, the heights of the point above the
// faces; likewise at a vertex (proofs.md, "Convex bodies"). A point where A and B are deepest in
// each other is far below all other faces, and few edges are left.

namespace touchstone {
namespace {

struct CylinderInHullFrame {
  const ConvexTables& b;
  double r, h;
  Vec3 d;          ///< the cylinder's centre
  Vec3 u;          ///< its axis
  double lengths;  ///< all together

  double gap(const Vec3& n) const {
    return d.dot(n) - h * std::abs(u.dot(n)) - r * u.cross(n).norm() - b.support(n);
  }
};
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

/// Is a gap the one that a feature alone has, so that the hull is met there?
bool is_that_of_feature(const InHull& p, double gap, double of_feature) {
  return gap >= of_feature - proof_part * p.lengths;
}

/// A normal, and what of the hull meets A along it.
struct Meeting {
  enum class Kind {
    vertex_of_cap,  ///< a vertex on the cap
    face,
    edge,            ///< across the side
    vertex_of_side,  ///< beside the side, or off a rim
    edge_of_rim
  };
  StageResult found;
  Kind kind;
  int feature;  ///< its index
  Vec3 place;   ///< of it, where the bodies meet

  void improve(const Meeting& later) {
    if (later.found.gap > found.gap) *this = later;
  }
};
using Kind = Meeting::Kind;

/// Is proven where the hull's vertex that faces the cap lies on it, its depth away from the rim:
/// the bodies are no nearer than that, and the ball of that depth about it is in A.
Meeting cap(const InHull& p) {
  using Four = ConvexTables::Four;
  Four lowest = p.b.vertices.front().along(p.u), highest = lowest;
  for (std::size_t i = 1; i < p.b.vertices.size(); ++i) {
    const Four z = p.b.vertices[i].along(p.u);
    lowest = lowest.min(z), highest = highest.max(z);
  }
  const double low = lowest.minCoeff(), high = highest.maxCoeff(), centre = p.d.dot(p.u);
  const double above = centre - p.h - high, below = low - centre - p.h;
  const bool is_above = above >= below;
  const double gap = is_above ? above : below, delta = depth(gap);
  const int vertex = p.b.first_at(p.u, is_above ? high : low);
  const Vec3 place = p.b.vertex(vertex), arm = place - p.d;
  const Vec3 across = arm - arm.dot(p.u) * p.u;
  const double room = p.r - delta;
  const bool is_proven = delta <= p.h && room >= 0 && across.squaredNorm() <= room * room;
  return {at(gap, is_above ? p.u : Vec3(-p.u), is_proven), Kind::vertex_of_cap, vertex, place};
}

/// The best face, if it is better than that.
Meeting face(const InHull& p, double best) {
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
  return {at(best, p.b.face_normal(found)), Kind::face, found,
          p.b.face_middles[static_cast<std::size_t>(found)]};
}

/// Of what is left of a unit vector without its part along another one, rounding counts where it is
/// shorter than this.
constexpr double few_digits = 0.1;

/// A's point that faces the hull along n; of a cap or generator that lies across n, the one that is
/// nearest to x.
Vec3 point_facing(const InHull& p, const Vec3& n, const Vec3& x) {
  constexpr double flat = 1e-15;
  const double along = n.dot(p.u);
  const double height = std::abs(along) > flat ? -std::copysign(p.h, along)
                                               : std::clamp((x - p.d).dot(p.u), -p.h, p.h);
  const Vec3 centre = p.d + height * p.u;
  Vec3 outward = n - along * p.u;
  const double sine = outward.norm();
  if (sine >= few_digits) return centre - p.r / sine * outward;
  if (sine > flat) {  // on the rim or side, unless it is only what rounding leaves along the axis
    outward /= sine;
    outward -= outward.dot(p.u) * p.u;
    const double length = outward.norm();
    if (length > 0.5) return centre - p.r / length * outward;
  }
  const Vec3 arm = x - p.d, beside = arm - arm.dot(p.u) * p.u;
  return centre + std::min(1.0, p.r / beside.norm()) * beside;
}

/// Which edge of a face a point is the farthest beyond, seen along its normal, and how far
/// (negative within all of them).
struct BeyondEdge {
  int edge = 0;
  double by = -std::numeric_limits<double>::infinity();

  BeyondEdge(const InHull& p, int face, const Vec3& x) {
    const Vec3& n = p.b.face_normal(face);
    for (const ConvexTables::FaceEdge& e : p.b.face_edges.of(face)) {
      const ConvexTables::Edge& other = p.b.edges[e.edge];
      const double outward = other.along.cross(n).dot(x - other.from);
      const double beyond = other.left == face ? outward : -outward;
      if (beyond > by) edge = e.edge, by = beyond;
    }
  }
};

/// A's point that faces the face lies on it, its depth away from the edges, and A is that thick:
/// with a disc about that point no less than the depth leads out (proofs.md, "Convex bodies"),
/// whether or not there is anything of the hull behind the face.
bool is_proven_at_face(const InHull& p, double gap, const BeyondEdge& nearest) {
  const double delta = depth(gap);
  return delta <= std::min(p.r, p.h) && nearest.by <= -delta;
}

/// Does a point lie so deep in A that a ball of this radius about it does, too? Then no normal of
/// bodies that share it has less depth.
bool holds_ball(const InHull& p, const Vec3& x, double depth) {
  const Vec3 arm = p.d - x;
  const double height = arm.dot(p.u), room = p.r - depth;
  const Vec3 across = arm - height * p.u;
  return std::abs(height) <= p.h - depth && room >= 0 && across.squaredNorm() <= room * room;
}

/// A's point that faces a face, and how high it lies above that.
struct FacingPoint {
  Vec3 x;
  double height;

  FacingPoint(const InHull& p, int face)
      : x(point_facing(p, p.b.face_normal(face), p.b.face_middles[static_cast<std::size_t>(face)])),
        height(p.b.height(x, face)) {}
};

/// The edges that A's point x leaves open for a gap above the best one.
class OpenEdges {
 public:
  /// All of them.
  explicit OpenEdges(const InHull& p) : p_(p) {}
  OpenEdges(const InHull& p, const Vec3& x, double best)
      : p_(p), x_(x), is_excluding_(true), margin_(rounding_part / 2 * p.lengths) {
    closed_ = std::min(best, 0.0) - margin_;
    level_ = best <= 0 ? best + margin_ / 2 : closed_;
  }

  /// Calls visit(edge, face, other), indices of an edge and the faces beside it, until it returns
  /// false.
  template <class Visit>
  void visit(Visit visit) const {
    if (!is_excluding_) {
      for (std::size_t i = 0; i < p_.b.edges.size(); ++i) {
        if (!visit(static_cast<int>(i), p_.b.edges[i].left, p_.b.edges[i].right)) return;
      }
      return;
    }
    for (std::size_t i = 0; i < p_.b.faces.size(); ++i) {
      const ConvexTables::Four heights = p_.b.faces[i].heights(x_);
      if (heights.maxCoeff() <= closed_) continue;
      for (int k = 0; k < 4; ++k) {
        const int face = 4 * static_cast<int>(i) + k;
        if (heights[k] <= closed_ || face >= p_.b.face_count) continue;
        for (const ConvexTables::FaceEdge& e : p_.b.face_edges.of(face)) {
          const bool is_other_closed = p_.b.height(x_, e.other) <= closed_;
          if (is_other_closed ? heights[k] <= level_ : e.other < face) continue;
          if (!visit(e.edge, face, e.other)) return;
        }
      }
    }
  }
  /// Whether a point of A that faces a face leaves the edge to another one open; and the point that
  /// faces that one, too: each may exclude the normals up to the middle.
  bool leaves_open(const ConvexTables::Edge& e, const FacingPoint& x, int other) const {
    if (!(x.height <= level_)) return true;
    if (p_.b.height(x.x, other) <= closed_) return false;
    const auto excludes_half = [&](const FacingPoint& y) {
      return y.height <= level_ && e.middle.dot(y.x - e.from) <= closed_;
    };
    return !(excludes_half(x) && excludes_half(FacingPoint(p_, other)));
  }

 private:
  const InHull& p_;
  Vec3 x_ = Vec3::Zero();
  bool is_excluding_ = false;
  double margin_ = 0, closed_ = 0, level_ = 0;
};

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
  StageResult found = tried(p, side * seen.aside, distance - p.r, seen.edge.from, best);
  if (!(found.gap > best)) return found;
  const double along_edge = seen.on_edge(), delta = depth(found.gap);
  found.is_proven = is_that_of_feature(p, found.gap, distance - p.r) && delta <= p.r &&
                    std::abs(seen.on_axis()) <= p.h - delta && along_edge >= 0 &&
                    along_edge <= seen.edge.length;
  return found;
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
  if (is_beside && (radial - p.r - best) * radial > across.dot(to_other)) {
    Vec3 n = across / radial;
    n -= n.dot(p.u) * p.u;  // what rounding leaves along the axis counts over its whole length
    const double length = n.norm();
    if (length > 0.5) {  // else the vertex is on the axis, but for rounding
      found = tried(p, n / length, radial - p.r, v, best);
      const double delta = depth(found.gap);
      found.is_proven = is_that_of_feature(p, found.gap, radial - p.r) &&
                        std::abs(height) <= p.h - delta && delta <= p.r;
    }
  }
  if (!(above > 0)) return found;
  const double beside = radial - p.r;
  const double most = std::max(best, found.gap);
  if (!(beside > 0) || (most > 0 && above * above + beside * beside <= most * most)) return found;
  const Vec3 off = std::copysign(above, height) * p.u + (beside / radial) * across;
  const Vec3 n = off.normalized();
  if (LargestGap::is_unit(n)) {
    const double distance = off.norm();
    StageResult later = tried(p, n, distance, v, most);  // of two points
    later.is_proven = is_that_of_feature(p, later.gap, distance);
    found.improve(later);
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

/// Proofs for a normal at which a rim and an edge meet (`bends_away`): `nu` is n·u, `squared`
/// 1 − nu², `slope` what is left of the gap's derivative across the edge. Where the hull goes on
/// across the edge is not asked, so that A alone has to be thick enough.
bool is_proven_at_rim(const InHull& p, const SeenAlongEdge& seen, double end, double nu,
                      double squared, double gap, double slope) {
  const double where = seen.arm.dot(seen.edge.along) - end * p.h * seen.cosine +
                       p.r * nu * seen.cosine / std::sqrt(squared);
  const double beyond = std::min(where, seen.edge.length - where);
  if (!(beyond > 0)) return false;
  const double rounding = proof_part * p.lengths;
  if (is_met_by_points(gap, slope, rounding)) return true;
  const double squared_sine = seen.cosine * seen.cosine / squared;
  return bends_away({p.r, p.h}, {2 * beyond, 0}, squared_sine, depth(gap), slope + rounding);
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
      if (found.gap > best && !highest && is_that_of_feature(p, found.gap, promised)) {
        const double slope =
            std::abs(x * ahead - y * beside + (p.r - b) * (p.r + b) * x * y / reach);
        found.is_proven =
            is_proven_at_rim(p, seen, end, end * seen.sine * y,
                             x * x + seen.cosine * seen.cosine * (y * y), found.gap, slope);
      }
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

/// Of the edges that lead from a vertex along `way`, the one that falls off least along n; -1 if
/// there is none.
int highest_edge(const InHull& p, int vertex, const Vec3& way, const Vec3& n) {
  int found = -1;
  double most = -std::numeric_limits<double>::infinity();
  for (const int i : p.b.vertex_edges.of(vertex)) {
    const ConvexTables::Edge& e = p.b.edges[static_cast<std::size_t>(i)];
    const double sign = e.vertices[0] == vertex ? 1 : -1, onward = sign * e.along.dot(way);
    if (!(onward > 0)) continue;
    const double rises = sign * e.along.dot(n);
    if (rises > most * onward) most = rises / onward, found = i;
  }
  return found;
}

/// Where the best normal is not proven, because the place at which the bodies would meet lies
/// beyond an edge or a rim: what meets there instead, if that is better.
Meeting likely(const InHull& p, const Meeting& best, int beyond) {
  const Vec3 n = best.found.normal();
  const auto side_and_vertex = [&](int vertex, const Vec3& to_other) -> Meeting {
    const Vec3& v = p.b.vertex(vertex);
    return {side_or_rim_and_vertex(p, v, to_other, best.found.gap), Kind::vertex_of_side, vertex,
            v};
  };
  int edge = beyond;
  double end = std::copysign(1, n.dot(p.u));
  bool may_be_side = true;
  switch (best.kind) {
    case Kind::vertex_of_cap: {
      const Vec3 arm = p.d - best.place, across = arm - arm.dot(p.u) * p.u;
      edge = highest_edge(p, best.feature, across, n);
      if (edge >= 0 && across.squaredNorm() <= p.r * p.r) {
        const ConvexTables::Edge& e = p.b.edges[static_cast<std::size_t>(edge)];
        const double to_other = e.vertices[0] == best.feature ? e.length : -e.length;
        return side_and_vertex(best.feature, to_other * e.along);
      }
      break;
    }
    case Kind::face:
      break;
    case Kind::edge:
    case Kind::vertex_of_side:
      end = std::copysign(1, (p.d - best.place).dot(p.u));
      edge = best.kind == Kind::edge ? best.feature : highest_edge(p, best.feature, end * p.u, n);
      may_be_side = best.kind != Kind::edge;
      break;
    case Kind::edge_of_rim:
      return {};
  }
  if (edge < 0) return {};
  const SeenAlongEdge seen(p, p.b.edges[static_cast<std::size_t>(edge)]);
  if (!seen.is_crossed) return {};
  const double along = seen.on_edge();
  if (may_be_side && std::abs(seen.on_axis()) <= p.h) {
    if (along >= 0 && along <= seen.edge.length) {
      return {side_and_edge(p, seen, best.found.gap), Kind::edge, edge, seen.nearest_to_axis()};
    }
    const Vec3 to_other = seen.edge.length * seen.edge.along;
    return along < 0 ? side_and_vertex(seen.edge.vertices[0], to_other)
                     : side_and_vertex(seen.edge.vertices[1], -to_other);
  }
  return {rim_and_edge(p, seen, end, best.found.gap, nullptr), Kind::edge_of_rim, edge,
          seen.edge.from};
}

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

StageResult largest_gap(const InHull& p, EarlyExit exit, double* highest) {
  Meeting best = cap(p);
  const auto is_over = [&] { return exit.ends_with(best.found); };
  if (is_over()) return best.found;
  best.improve(face(p, best.found.gap));
  if (is_over()) return best.found;
  // As deep in each other as this, bodies hardly ever come free where a rim meets an edge.
  constexpr double deep = 0.5;
  const auto try_likely = [&](int beyond) {
    for (int i = 0; i < 3 && depth(best.found.gap) < deep * std::min(p.r, p.h); ++i) {
      const Meeting next = likely(p, best, beyond);
      if (!(next.found.gap > best.found.gap)) return false;
      best = next;
      if (is_over()) return true;
    }
    return false;
  };
  if (exit.trusts_proofs) {
    int beyond = -1;
    if (best.kind == Kind::face) {
      const BeyondEdge edge(p, best.feature, point_facing(p, best.found.normal(), best.place));
      if (is_proven_at_face(p, best.found.gap, edge)) return best.found;
      beyond = edge.edge;
    }
    if (try_likely(beyond)) return best.found;
  }

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
      const StageResult found = side_and_edge(p, seen, best.found.gap);
      if (found.gap > best.found.gap) best = {found, Kind::edge, edge, seen.nearest_to_axis()};
    }
    for (int end = 0; end < 2; ++end) {
      const int i = e.vertices[end];
      if (!vertices.is_new(i)) continue;
      const Vec3 &v = p.b.vertex(i), &other = p.b.vertex(e.vertices[1 - end]);
      const StageResult found = side_or_rim_and_vertex(p, v, other - v, best.found.gap);
      if (found.gap > best.found.gap) best = {found, Kind::vertex_of_side, i, v};
    }
    return !is_over();
  });
  if (!is_any || is_over()) return best.found;
  if (exit.trusts_proofs && best.kind != Kind::face && try_likely(-1)) return best.found;
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
