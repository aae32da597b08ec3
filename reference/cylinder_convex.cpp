#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "convex_proofs.hpp"
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
// First comes what is likely, because of the best face or cap, or as seen along the axis. Unless
// that proves itself, of faces, edges and vertices those are tried that a point of A leaves open:
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
  const double side = std::copysign(1, above - below);
  const Vec3 n = side * p.u;
  const double gap = std::max(above, below), delta = depth(gap);
  const int vertex = p.b.first_at(n, above >= below ? high : -low);
  const Vec3 arm = p.b.vertex(vertex) - p.d, across = arm - arm.dot(p.u) * p.u;
  const double room = p.r - delta;
  const bool is_proven = (delta <= p.h) & (room >= 0) & (across.squaredNorm() <= room * room);
  return {at(gap, n, is_proven), Kind::vertex_of_cap, vertex};
}

double face_gap(const InHull& p, int face) {
  const Vec3& n = p.b.face_normal(face);
  return p.b.height(p.d, face) - p.h * std::abs(n.dot(p.u)) - p.r * n.cross(p.u).norm();
}
Meeting at_face(const InHull& p, int face) {
  return {at(face_gap(p, face), p.b.face_normal(face)), Kind::face, face};
}

/// The best of all faces.
Meeting best_face(const InHull& p) {
  int found = 0;
  double best = face_gap(p, 0);
  for (int f = 1; f < p.b.face_count; ++f) {
    const double gap = face_gap(p, f);
    if (gap > best) best = gap, found = f;
  }
  return at_face(p, found);
}

/// Finds the largest of many numbers, four at once and without a branch: the winner is
/// unpredictable. Of those that differ by less than a billionth of `scale` it is the first one, as
/// digits beyond that hold the index.
class LikelyBest {
 public:
  using Four = ConvexTables::Four;
  explicit LikelyBest(double scale)
      : rounder_(0x1p22 * scale), step_(0x1p-44 * scale), steps_(0x1p44 / scale) {}

  void offer(std::size_t fourth, const Four& x) {
    const double index = step_ * static_cast<double>(fourth);
    most_ = most_.max(((x + rounder_) - rounder_) - index);
  }
  struct Found {
    int index;
    double number;
  };
  Found found() const {
    const int low = most_[1] > most_[0], high = 2 + (most_[3] > most_[2]);
    const int k = low + (most_[high] > most_[low]) * (high - low);
    const double most = most_[k], number = (most + rounder_) - rounder_;
    return {4 * static_cast<int>((number - most) * steps_ + 0.5) + k, number};
  }

 private:
  double rounder_, step_, steps_;
  Four most_ = Four::Constant(-std::numeric_limits<double>::infinity());
};

/// One of those that are nearly the best, if it may be better than that: of faces along the axis
/// half of the digits are lost.
Meeting likely_face(const InHull& p, double best) {
  using Four = ConvexTables::Four;
  LikelyBest likely(p.lengths);
  for (std::size_t i = 0; i < p.b.faces.size(); ++i) {
    const ConvexTables::Planes& faces = p.b.faces[i];
    const Four cosine = faces.normal.along(p.u);
    const Four sine = (1 - cosine * cosine).max(0).sqrt();
    likely.offer(i, faces.heights(p.d) - p.h * cosine.abs() - p.r * sine);
  }
  constexpr double lost = 1e-7;
  const LikelyBest::Found found = likely.found();
  if (found.number + lost * p.lengths <= best) return {};
  return at_face(p, std::min(found.index, p.b.face_count - 1));
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

/// What the axis passes beside, seen along an edge: that edge, or a vertex at its end.
Meeting beside_side(const InHull& p, const SeenAlongEdge& seen, int edge, double best) {
  const double along = seen.on_edge(), length = seen.edge.length;
  if (along >= 0 && along <= length) {
    return {side_and_edge(p, seen, best), Kind::edge, edge};
  }
  const int vertex = seen.edge.vertices[along < 0 ? 0 : 1];
  const Vec3 to_other = (along < 0 ? length : -length) * seen.edge.along;
  return {side_or_rim_and_vertex(p, p.b.vertex(vertex), to_other, best), Kind::vertex_of_side,
          vertex};
}

/// Seen along the axis the hull is a polygon. The axis is beside the edge that it lies the farthest
/// beyond, or, past that edge's end, beside the vertex there.
Meeting likely_beside_side(const InHull& p, double best) {
  using Four = ConvexTables::Four;
  constexpr double noise = 1e-30, none = 1e60;
  const Vec3 turned = p.u.cross(p.d);
  LikelyBest farthest(p.lengths);
  for (std::size_t i = 0; i < p.b.lines.size(); ++i) {
    const ConvexTables::Lines& edges = p.b.lines[i];
    const Four left = edges.left.along(p.u), right = edges.right.along(p.u);
    const Four cosine = edges.along.along(p.u), falls = left - right;
    const Four sine = (1 - cosine * cosine).max(noise).sqrt() * (falls.abs() + noise);
    const Four beyond = edges.along.along(turned) - edges.moment.along(p.u);
    farthest.offer(i, (beyond * falls / sine - none * (left * right).max(0)).max(-p.lengths));
  }
  const LikelyBest::Found found = farthest.found();
  if (!(found.number - p.r > best)) return {};
  const int edge = std::min(found.index, static_cast<int>(p.b.edges.size()) - 1);
  const SeenAlongEdge seen(p, p.b.edges[static_cast<std::size_t>(edge)]);
  if (!seen.is_crossed) return {};
  return beside_side(p, seen, edge, best);
}

/// Where the best normal is not proven, because the place at which the bodies would meet lies
/// beyond an edge or a rim: what meets there instead, if that is better.
Meeting likely(const InHull& p, const Meeting& best, int beyond) {
  const Vec3 n = best.found.normal();
  int edge = beyond;
  double end = std::copysign(1, n.dot(p.u));
  bool may_be_side = true;
  switch (best.kind) {
    case Kind::vertex_of_cap: {
      const Vec3& v = p.b.vertex(best.feature);
      const Vec3 arm = p.d - v, across = arm - arm.dot(p.u) * p.u;
      edge = highest_edge(p, best.feature, across, n);
      if (edge >= 0 && across.squaredNorm() <= p.r * p.r) {
        const ConvexTables::Edge& e = p.b.edges[static_cast<std::size_t>(edge)];
        const double to_other = e.vertices[0] == best.feature ? e.length : -e.length;
        return {side_or_rim_and_vertex(p, v, to_other * e.along, best.found.gap),
                Kind::vertex_of_side, best.feature};
      }
      break;
    }
    case Kind::face:
      break;
    case Kind::edge:
      may_be_side = false;
      edge = best.feature;
      break;
    case Kind::vertex_of_side:
      end = std::copysign(1, (p.d - p.b.vertex(best.feature)).dot(p.u));
      edge = highest_edge(p, best.feature, end * p.u, n);
      break;
    case Kind::edge_of_rim:
      return {};
  }
  if (edge < 0) return {};
  const SeenAlongEdge seen(p, p.b.edges[static_cast<std::size_t>(edge)]);
  if (!seen.is_crossed) return {};
  if (may_be_side && std::abs(seen.on_axis()) <= p.h) {
    return beside_side(p, seen, edge, best.found.gap);
  }
  if (!may_be_side) end = std::copysign(1, (p.d - seen.nearest_to_axis()).dot(p.u));
  return {rim_and_edge(p, seen, end, best.found.gap, nullptr), Kind::edge_of_rim, edge};
}
/// Puts that in the place of the best one, as long as it is better. Returns whether the search is
/// over.
bool try_likely(const InHull& p, EarlyExit exit, Meeting& best, int beyond) {
  // As deep in each other as this, bodies hardly ever come free where a rim meets an edge.
  constexpr double deep = 0.5;
  for (int i = 0; i < 3 && depth(best.found.gap) < deep * std::min(p.r, p.h); ++i) {
    const Meeting next = likely(p, best, beyond);
    if (!(next.found.gap > best.found.gap)) return false;
    best = next;
    if (exit.ends_with(best.found)) return true;
  }
  return false;
}

/// Where on the hull the bodies meet.
Vec3 place_of(const InHull& p, const Meeting& best) {
  const auto i = static_cast<std::size_t>(best.feature);
  switch (best.kind) {
    case Kind::face:
      return p.b.face_middles[i];
    case Kind::edge:
      return SeenAlongEdge(p, p.b.edges[i]).nearest_to_axis();
    case Kind::edge_of_rim:
      return p.b.edges[i].from;
    default:
      return p.b.vertex(best.feature);
  }
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

/// Tries all that A's point where the bodies meet leaves open. Out of line: mostly it is not
/// needed.
[[gnu::noinline]] StageResult search_open_edges(const InHull& p, EarlyExit exit, Meeting best,
                                                double* highest) {
  const auto is_over = [&] { return exit.ends_with(best.found); };
  const auto open_edges = [&] {
    if (!exit.trusts_proofs) return OpenEdges(p);
    return OpenEdges(p, point_facing(p, best.found.normal(), place_of(p, best)), best.found.gap);
  };
  const OpenEdges open = open_edges();
  if (exit.trusts_proofs) {
    open.visit_faces([&](int face, double) {
      best.improve(at_face(p, face));
      return true;
    });
  }
  Tried vertices(p);
  bool is_any = false;
  open.visit([&](int edge, int, int) {
    is_any = true;
    const ConvexTables::Edge& e = p.b.edges[static_cast<std::size_t>(edge)];
    if (may_cross_side(p, e, best.found.gap)) {
      best.improve({side_and_edge(p, SeenAlongEdge(p, e), best.found.gap), Kind::edge, edge});
    }
    for (int end = 0; end < 2; ++end) {
      const int i = e.vertices[end];
      if (!vertices.is_new(i)) continue;
      const Vec3 &v = p.b.vertex(i), &other = p.b.vertex(e.vertices[1 - end]);
      best.improve(
          {side_or_rim_and_vertex(p, v, other - v, best.found.gap), Kind::vertex_of_side, i});
    }
    return !is_over();
  });
  if (!is_any || is_over()) return best.found;
  if (exit.trusts_proofs && best.kind != Kind::face && try_likely(p, exit, best, -1)) {
    return best.found;
  }
  // Here A's point that faces each face excludes most of its edges.
  const OpenEdges left = open_edges();
  int at = -1;
  std::optional<FacingPoint> x;
  left.visit([&](int edge, int face, int other) {
    const ConvexTables::Edge& e = p.b.edges[static_cast<std::size_t>(edge)];
    if (exit.trusts_proofs) {
      if (face != at) {
        at = face;
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

StageResult largest_gap(const InHull& p, EarlyExit exit, double* highest) {
  Meeting best = cap(p);
  if (exit.ends_with(best.found)) return best.found;
  best.improve(exit.trusts_proofs ? likely_face(p, best.found.gap) : best_face(p));
  if (exit.ends_with(best.found)) return best.found;
  if (exit.trusts_proofs) {
    int beyond = -1;
    if (best.kind == Kind::face) {
      const BeyondEdge edge(p, best.feature,
                            point_facing(p, best.found.normal(), place_of(p, best)));
      if (is_proven_at_face(p, best.found.gap, edge)) return best.found;
      beyond = edge.edge;
    }
    if (try_likely(p, exit, best, beyond)) return best.found;
    constexpr std::size_t few = 8;  // else they take longer than what they save
    if (best.kind != Kind::edge_of_rim && p.b.lines.size() <= few) {
      const Meeting beside = likely_beside_side(p, best.found.gap);
      if (beside.found.gap > best.found.gap) {
        best = beside;
        if (exit.ends_with(best.found) || try_likely(p, exit, best, -1)) return best.found;
      }
    }
  }
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
