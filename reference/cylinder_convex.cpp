#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "convex_tables.hpp"
#include "curves.hpp"
#include "pair.hpp"

// In the hull's frame the largest gap lies at one normal of six kinds, tried in this order:
//
//   cap, face        of one of the bodies; often one of its points proves it
//   side_and_edge    across axis and edge: mostly proven where they cross
//   side_and_vertex  across the axis: a vertex beside the side
//   rim_and_vertex   neither, only apart: a vertex off a rim
//   rim_and_edge     across an edge: it crosses a rim, which is a point against an ellipse, seen
//                    along the edge
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
/// Of a normal for which one feature of the hull promises more than the best gap.
StageResult tried(const InHull& p, const Vec3& n, double best) {
  const double gap = p.gap(n);
  return gap > best ? at(gap, n) : StageResult{};
}

/// What is compared without its root is at least this part of what counts.
constexpr double less_a_hair = 1 - 1e-12;

/// Is a gap the one that a feature alone has, so that the hull is met there?
bool is_that_of_feature(const InHull& p, double gap, double of_feature) {
  return gap >= of_feature - proof_part * p.lengths;
}

/// A normal, and a place of the hull where the bodies meet along it.
struct Meeting {
  StageResult found;
  Vec3 place;

  void improve(const StageResult& later, const Vec3& there) {
    if (later.gap > found.gap) place = there;
    found.improve(later);
  }
};

/// Is proven where the hull's vertex that faces the cap lies on it, its depth away from the rim:
/// the bodies are no nearer than that, and the ball of that depth about it is in A.
Meeting cap(const InHull& p) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  int lowest = 0, highest = 0;
  for (std::size_t i = 0; i < p.b.vertices.size(); ++i) {
    const ConvexTables::Four z = p.b.vertices[i].along(p.u);
    for (int k = 0; k < 4; ++k) {
      if (z[k] < low) low = z[k], lowest = 4 * static_cast<int>(i) + k;
      if (z[k] > high) high = z[k], highest = 4 * static_cast<int>(i) + k;
    }
  }
  const double centre = p.d.dot(p.u);
  const double above = centre - p.h - high, below = low - centre - p.h;
  const bool is_above = above >= below;
  const double gap = is_above ? above : below, delta = depth(gap);
  const Vec3 place = p.b.vertex(is_above ? highest : lowest), arm = place - p.d;
  const Vec3 across = arm - arm.dot(p.u) * p.u;
  const double room = p.r - delta;
  const bool is_proven = delta <= p.h && room >= 0 && across.squaredNorm() <= room * room;
  return {at(gap, is_above ? p.u : Vec3(-p.u), is_proven), place};
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
    for (int k = 0; k < 4; ++k) {
      if (gaps[k] > best) best = gaps[k], found = 4 * static_cast<int>(i) + k;
    }
  }
  if (found < 0) return {};
  found = std::min(found, p.b.face_count - 1);
  return {at(best, p.b.face_normal(found)), p.b.face_middles[static_cast<std::size_t>(found)]};
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
  if (sine > flat) {  // on the rim or side, whatever rounding leaves along the axis
    outward /= sine;
    outward -= outward.dot(p.u) * p.u;
    return centre - p.r / outward.norm() * outward;
  }
  const Vec3 arm = x - p.d, beside = arm - arm.dot(p.u) * p.u;
  return centre + std::min(1.0, p.r / beside.norm()) * beside;
}

/// Does a point lie so deep in A that a ball of this radius about it does, too? Then no normal of
/// bodies that share it has less depth.
bool holds_ball(const InHull& p, const Vec3& x, double depth) {
  const Vec3 arm = p.d - x;
  const double height = arm.dot(p.u), room = p.r - depth;
  const Vec3 across = arm - height * p.u;
  return std::abs(height) <= p.h - depth && room >= 0 && across.squaredNorm() <= room * room;
}

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

  /// Calls visit(edge, face, other), the faces beside it, until it returns false.
  template <class Visit>
  void visit(Visit visit) const {
    if (!is_excluding_) {
      for (const ConvexTables::Edge& e : p_.b.edges) {
        if (!visit(e, e.left, e.right)) return;
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
          if (!visit(p_.b.edges[e.edge], face, e.other)) return;
        }
      }
    }
  }
  /// Whether a point of A leaves an edge between a face, above which it has this height, and
  /// another one open.
  bool leaves_open(const Vec3& x, double height_of_face, int other) const {
    return !(height_of_face <= level_ && p_.b.height(x, other) <= closed_);
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
  const double distance = std::copysign(1, across.dot(e.middle)) * across.dot(p.d - e.from) +
                          proof_part * p.lengths;
  const double least = best + p.r;
  if (least <= 0) return true;
  return distance > 0 && distance * distance > least * least * across.squaredNorm() * less_a_hair;
}

StageResult side_and_edge(const InHull& p, const SeenAlongEdge& seen, double best) {
  if (!seen.is_crossed) return {};
  const double side = std::copysign(1, seen.aside.dot(seen.edge.middle));
  const double distance = side * seen.arm.dot(seen.aside);
  if (!(distance - p.r > best)) return {};
  StageResult found = tried(p, side * seen.aside, best);
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
      found = tried(p, n / length, best);
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
  if (LargestGap::is_unit(n)) found.improve(tried(p, n, most));
  return found;
}

/// Two chords of the ellipse's quadrant meet at (r, b)/√2: is the point (x, y) further behind both
/// than the best depth?
bool is_far_behind_chords(double r, double b, double x, double y, double best) {
  constexpr double mid = 0.41421356237309505;  // √2 − 1
  const double across = r * b - b * x - r * mid * y, along = r * b - b * mid * x - r * y;
  const double squared = depth(best) * depth(best);
  return across > 0 && across * across >= squared * (b * b + mid * mid * r * r) && along > 0 &&
         along * along >= squared * (r * r + mid * mid * b * b);
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

/// Both rims. `highest`, where it is asked for, is raised to a bound of the gaps of all normals
/// along which one of them and the edge face each other.
StageResult rim_and_edge(const InHull& p, const SeenAlongEdge& seen, double best, double* highest) {
  if (!seen.is_crossed) return {};
  const double b = p.r * std::abs(seen.cosine);
  const double side = std::copysign(1, seen.arm.dot(seen.aside));
  const double beside = without_vanishing(side * seen.arm.dot(seen.aside));
  const double along = seen.arm.dot(seen.ahead);
  const Vec3 left = p.b.face_normal(seen.edge.left), right = p.b.face_normal(seen.edge.right);
  const auto points_to = [&](const Vec3& way) {
    return std::max({left.dot(way), seen.edge.middle.dot(way), right.dot(way)}) >= 0;
  };
  StageResult found;
  if (!points_to(side * seen.aside)) return found;
  for (const double end : {1.0, -1.0}) {
    const double ahead = without_vanishing(end * along - p.h * seen.sine);
    const double least = std::max(best, found.gap), bound = least + b;
    const double out = std::max(ahead, 0.0);
    if (bound >= 0 && beside * beside + out * out <= bound * bound) continue;
    if (!points_to(end * seen.ahead)) continue;
    if (is_far_behind_chords(p.r, b, beside, ahead, least)) continue;
    const auto foot = ellipse_normal(p.r, b, beside, ahead);
    if (foot) {
      const double x = foot->x(), y = foot->y();
      const double reach = std::sqrt(p.r * x * (p.r * x) + b * y * (b * y));
      if (beside * x + ahead * y - reach > least) {
        found.improve(tried(p, end * y * seen.ahead + side * x * seen.aside, least));
      }
    }
    if (!highest) continue;
    const Vec3 out1 = seen.edge.along.cross(left), out2 = right.cross(seen.edge.along);
    const auto seen_way = [&](const Vec3& way) {
      return Vec2(side * way.dot(seen.aside), end * way.dot(seen.ahead));
    };
    const double most = std::max(best, found.gap);
    *highest = std::max(*highest, most + missed_on_arc(p.r, b, beside, ahead, foot, seen_way(out1),
                                                       seen_way(out2), most));
  }
  return found;
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
  const Meeting on_face = face(p, best.found.gap);
  best.improve(on_face.found, on_face.place);
  if (is_over()) return best.found;

  const auto open_edges = [&] {
    if (!exit.trusts_proofs) return OpenEdges(p);
    return OpenEdges(p, point_facing(p, best.found.normal(), best.place), best.found.gap);
  };
  Tried vertices(p);
  bool is_any = false;
  open_edges().visit([&](const ConvexTables::Edge& e, int, int) {
    is_any = true;
    if (may_cross_side(p, e, best.found.gap)) {
      const SeenAlongEdge seen(p, e);
      const StageResult found = side_and_edge(p, seen, best.found.gap);
      if (found.gap > best.found.gap) best.improve(found, seen.nearest_to_axis());
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
  double height = 0;
  Vec3 x;
  left.visit([&](const ConvexTables::Edge& e, int face, int other) {
    if (exit.trusts_proofs) {
      if (face != at_face) {
        at_face = face;
        x = point_facing(p, p.b.face_normal(face),
                         p.b.face_middles[static_cast<std::size_t>(face)]);
        height = p.b.height(x, face);
      }
      if (!left.leaves_open(x, height, other)) return true;
      const double delta = depth(best.found.gap) + rounding_part * p.lengths;
      if (holds_ball(p, e.from, delta) || holds_ball(p, e.from + e.length * e.along, delta)) {
        return true;
      }
    }
    best.found.improve(rim_and_edge(p, SeenAlongEdge(p, e), best.found.gap, highest));
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
