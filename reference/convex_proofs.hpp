#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "convex_tables.hpp"
#include "largest_gap.hpp"

namespace touchstone {

// What ends the search of a hull: that a normal has the largest gap, or that no normal of an edge,
// of a vertex or of a face can have a larger one (proofs.md, "Convex bodies").

struct CylinderInHullFrame {
  const ConvexTables& b;
  double r, h;
  Vec3 d;          ///< the cylinder's centre
  Vec3 u;          ///< its axis
  double lengths;  ///< all together
};
/// Of what is left of a unit vector without its part along another one, rounding counts where it is
/// shorter than this.
inline constexpr double few_digits = 0.1;

/// A cap or generator lies across a normal with no larger a sine or cosine than that.
inline constexpr double flat_cosine = 1e-15;

/// A's point that faces the hull along n; of a cap or generator that lies across n, the one that is
/// nearest to x.
inline Vec3 point_facing(const CylinderInHullFrame& p, const Vec3& n, const Vec3& x) {
  const double along = n.dot(p.u);
  const double height = std::abs(along) > flat_cosine ? -std::copysign(p.h, along)
                                                      : std::clamp((x - p.d).dot(p.u), -p.h, p.h);
  const Vec3 centre = p.d + height * p.u;
  Vec3 outward = n - along * p.u;
  const double sine = outward.norm();
  if (sine >= few_digits) return centre - p.r / sine * outward;
  // On the rim or side, unless it is only what rounding leaves along the axis.
  if (sine > flat_cosine) {
    outward /= sine;
    outward -= outward.dot(p.u) * p.u;
    const double length = outward.norm();
    if (length > 0.5) return centre - p.r / length * outward;
  }
  const Vec3 arm = x - p.d, beside = arm - arm.dot(p.u) * p.u;
  return centre + std::min(1.0, p.r / beside.norm()) * beside;
}

/// A along the normal of a face: the gap, and which edge of the face A's point that faces it is the
/// farthest beyond, seen along the normal. How far, negative within all of them, is known times a
/// scale, so that nothing waits until a root has divided.
struct AtFace {
  const Vec3& n;
  double gap, beyond, scale = 1;
  int edge = 0;

  AtFace(const CylinderInHullFrame& p, int face) : n(p.b.face_normal(face)) {
    const double along = n.dot(p.u);
    const Vec3 outward = n - along * p.u;
    const double sine = outward.norm();
    gap = p.b.height(p.d, face) - p.h * std::abs(along) - p.r * sine;
    if (sine >= few_digits && std::abs(along) > flat_cosine) [[likely]] {
      scale = sine;
      find_edge(p, face, p.d - std::copysign(p.h, along) * p.u, p.r * outward);
    } else {
      const Vec3& middle = p.b.face_middles[static_cast<std::size_t>(face)];
      find_edge(p, face, point_facing(p, n, middle), Vec3::Zero());
    }
  }
  /// A's point lies on the face, its depth away from the edges, and A is that thick: with a disc
  /// about that point no less than the depth leads out (proofs.md, "Convex bodies"), whether or not
  /// there is anything of the hull behind the face.
  bool is_proven(const CylinderInHullFrame& p) const {
    const double delta = depth(gap);
    return delta <= std::min(p.r, p.h) && beyond <= -delta * scale;
  }

 private:
  /// Of the point x - arm / scale.
  void find_edge(const CylinderInHullFrame& p, int face, const Vec3& x, const Vec3& arm) {
    beyond = -std::numeric_limits<double>::infinity();
    for (const ConvexTables::FaceEdge& e : p.b.face_edges.of(face)) {
      const double by = scale * e.outward.dot(x - p.b.edges[e.edge].from) - e.outward.dot(arm);
      edge = by > beyond ? e.edge : edge;  // branch-free: the winner is unpredictable
      beyond = std::max(beyond, by);
    }
  }
};

/// Does a point lie so deep in A that a ball of this radius about it does, too? Then no normal of
/// bodies that share it has less depth.
inline bool holds_ball(const CylinderInHullFrame& p, const Vec3& x, double depth) {
  const Vec3 arm = p.d - x;
  const double height = arm.dot(p.u), room = p.r - depth;
  const Vec3 across = arm - height * p.u;
  return std::abs(height) <= p.h - depth && room >= 0 && across.squaredNorm() <= room * room;
}

/// A's point that faces a face, and how high it lies above that.
struct FacingPoint {
  Vec3 x;
  double height;

  FacingPoint(const CylinderInHullFrame& p, int face)
      : x(point_facing(p, p.b.face_normal(face), p.b.face_middles[static_cast<std::size_t>(face)])),
        height(p.b.height(x, face)) {}
};

/// The edges that A's point x leaves open for a gap above the best one.
class OpenEdges {
 public:
  /// All of them.
  explicit OpenEdges(const CylinderInHullFrame& p) : p_(p) {}
  OpenEdges(const CylinderInHullFrame& p, const Vec3& x, double best)
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
  const CylinderInHullFrame& p_;
  Vec3 x_ = Vec3::Zero();
  bool is_excluding_ = false;
  double margin_ = 0, closed_ = 0, level_ = 0;
};

}  // namespace touchstone
