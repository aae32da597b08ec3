#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "deep_normals.hpp"
#include "largest_gap.hpp"
#include "shape.hpp"

namespace touchstone {

/// A cylinder and a box in the box's frame.
struct CylinderInBoxFrame {
  double r, h;
  Vec3 e;  ///< the box's half extents
  Vec3 d;  ///< the cylinder's centre
  Vec3 u;  ///< its axis
  Vec3 s;  ///< sines of the angles between u and the box's axes

  CylinderInBoxFrame(double radius, double half_length, const Vec3& half_extents,
                     const Vec3& centre, const Vec3& axis)
      : r(radius), h(half_length), e(half_extents) {
    for (int i = 0; i < 3; ++i) {
      d[i] = without_vanishing(centre[i]);
      u[i] = without_vanishing(axis[i]);
    }
    for (int i = 0; i < 3; ++i) {
      const double y = u[(i + 1) % 3], z = u[(i + 2) % 3];
      s[i] = std::sqrt(y * y + z * z);
    }
  }
  /// All lengths together.
  double lengths() const { return d.cwiseAbs().sum() + e.sum() + r + h; }
  double gap(const Vec3& n) const {
    return d.dot(n) - e.dot(n.cwiseAbs()) - h * std::abs(u.dot(n)) - r * u.cross(n).norm();
  }
};

/// The best face, across an axis of the box.
struct BestFace {
  int axis = 0;
  double gap = -std::numeric_limits<double>::infinity();
};
inline BestFace best_face(const CylinderInBoxFrame& p) {
  BestFace best;
  for (int i = 0; i < 3; ++i) {
    const double gap = std::abs(p.d[i]) - p.e[i] - p.h * std::abs(p.u[i]) - p.r * p.s[i];
    if (gap > best.gap) best = {i, gap};
  }
  return best;
}
/// Where the point of A that faces that face lies, across it. A generator or cap that lies on it
/// offers its middle.
inline Vec3 point_facing(const BestFace& face, const CylinderInBoxFrame& p) {
  const int i = face.axis;
  constexpr double flat = 1e-15;
  const double along = std::copysign(1, p.d[i]) * p.u[i];
  const double end = std::abs(along) > flat ? -std::copysign(p.h, along) : 0;
  const double rim = p.s[i] > flat ? p.r / p.s[i] : 0;
  return p.d + (end + rim * along) * p.u;
}
/// Does a cap or generator that lies flat on that face share a point with it, which lies the depth
/// away from the face's edges, or, on the cap, from its rim, or, on the generator, from its ends?
inline bool is_shared(const BestFace& face, const CylinderInBoxFrame& p) {
  const double delta = depth(face.gap);
  const int i = face.axis, j = (i + 1) % 3, k = (i + 2) % 3;
  constexpr double flat = 1e-15;
  if (p.s[i] <= flat) {
    const auto is_near = [&](double inset, double reach) {
      const double x = std::max(std::abs(p.d[j]) - (p.e[j] - inset), 0.0);
      const double y = std::max(std::abs(p.d[k]) - (p.e[k] - inset), 0.0);
      return inset <= std::min(p.e[j], p.e[k]) && reach >= 0 && x * x + y * y <= reach * reach;
    };
    return (delta <= p.e[i] && is_near(delta, p.r)) || (delta <= p.h && is_near(0, p.r - delta));
  }
  if (!(std::abs(p.u[i]) <= flat)) return false;
  const auto is_crossed = [&](double inset, double half_length) {
    double lo = -half_length, hi = half_length;
    for (const int x : {j, k}) {
      const double u = std::abs(p.u[x]), d = std::copysign(1, p.u[x]) * p.d[x], e = p.e[x] - inset;
      if (!(e >= 0) || (u == 0 && std::abs(d) > e)) return false;
      if (u > 0) lo = std::max(lo, (-e - d) / u), hi = std::min(hi, (e - d) / u);
    }
    return lo <= hi;
  };
  return (delta <= p.e[i] && is_crossed(delta, p.h)) ||
         (delta <= p.r && is_crossed(0, p.h - delta));
}
/// A point of A that faces the box lies on the face, its depth away from the edges; or a cylinder
/// about the face's axis is proven for the box, as wide as the centre's distance from the nearest
/// edge: from there the box reaches at least as far in every direction.
inline bool is_proven(const BestFace& face, const CylinderInBoxFrame& p) {
  const double delta = depth(face.gap);
  const int i = face.axis, j = (i + 1) % 3, k = (i + 2) % 3;
  const Vec3 x = point_facing(face, p);
  if (delta <= p.e[i] && std::abs(x[j]) <= p.e[j] - delta && std::abs(x[k]) <= p.e[k] - delta) {
    return true;
  }
  if (is_shared(face, p)) return true;
  const double beside = std::min(p.e[j] - std::abs(p.d[j]), p.e[k] - std::abs(p.d[k]));
  return face.gap < 0 && beside >= 0 &&
         no_normal_beats_cap(
             {beside, p.e[i], p.r, p.h, std::abs(p.u[i]), p.s[i], std::abs(p.d[i]), 0}, delta);
}

/// The edge across which the side is the furthest: n = ±e × u.
struct BestEdge {
  int axis = 0;  ///< along which the edge lies
  double gap = -std::numeric_limits<double>::infinity();
  double outwards = 0;  ///< what scales ±e × u to a unit vector towards A

  Vec3 normal(const Vec3& u) const {
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    Vec3 n = Vec3::Zero();
    n[j] = -u[k] * outwards, n[k] = u[j] * outwards;
    return n;
  }
};
inline BestEdge best_edge(const CylinderInBoxFrame& p) {
  BestEdge best;
  for (int i = 0; i < 3; ++i) {
    if (!(p.s[i] > 0)) continue;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double along = p.d[k] * p.u[j] - p.d[j] * p.u[k];
    const double gap =
        (std::abs(along) - p.e[j] * std::abs(p.u[k]) - p.e[k] * std::abs(p.u[j])) / p.s[i] - p.r;
    if (gap > best.gap) best = {i, gap, std::copysign(1 / p.s[i], along)};
  }
  return best;
}
/// Where the axis passes that edge.
struct EdgeCrossing {
  double along_axis, along_edge;
  Vec3 corner;  ///< an end of the edge, the nearer one where the axis passes beyond it
};
inline EdgeCrossing crossing(const BestEdge& edge, const CylinderInBoxFrame& p) {
  const int i = edge.axis, j = (i + 1) % 3, k = (i + 2) % 3;
  EdgeCrossing c;
  c.corner[j] = std::copysign(p.e[j], -p.u[k] * edge.outwards);
  c.corner[k] = std::copysign(p.e[k], p.u[j] * edge.outwards);
  // Along m = (u_j, u_k)/s, across n and the edge.
  c.along_axis =
      ((c.corner[j] - p.d[j]) * p.u[j] + (c.corner[k] - p.d[k]) * p.u[k]) / (p.s[i] * p.s[i]);
  c.along_edge = p.d[i] + c.along_axis * p.u[i];
  c.corner[i] = std::copysign(p.e[i], c.along_edge);
  return c;
}
/// The edge and the generator cross within both, the generator's ends further than the depth.
inline bool is_proven(const BestEdge& edge, const CylinderInBoxFrame& p) {
  const double delta = depth(edge.gap);
  if (delta > p.r) return false;
  const EdgeCrossing c = crossing(edge, p);
  return std::abs(c.along_axis) <= p.h - delta && std::abs(c.along_edge) <= p.e[edge.axis];
}

/// A point of B that faces a cap with this gap and normal lies on it, its depth away from the rim.
inline bool is_proven_at_cap(const CylinderInBoxFrame& p, double gap, const Vec3& normal) {
  const double delta = depth(gap);
  if (delta > p.h || delta > p.r) return false;
  Vec3 across;  // from B's point to A's centre
  constexpr double flat = 1e-15;
  for (int i = 0; i < 3; ++i) {
    const double n = normal[i];
    across[i] = p.d[i] - (std::abs(n) > flat ? std::copysign(p.e[i], n)
                                             : std::clamp(p.d[i], -p.e[i], p.e[i]));
  }
  across -= across.dot(p.u) * p.u;
  return across.squaredNorm() <= (p.r - delta) * (p.r - delta);
}

/// The best of seven directions: three faces, the cap, an edge along each axis across the side.
///
/// Most of the time it is proven, because a smooth place of one body is met well within its bounds:
/// where the bodies overlap by δ, a ball of radius δ fits into the cylinder or box behind that
/// place, so that no way out is shorter than δ; deeper ones are bounded in deep_normals.hpp.
struct BoxSides {
  enum class Kind { face, edge, cap };
  BestFace face;
  BestEdge edge;
  double cap, cap_side;  ///< gap; ±1, along the axis towards A

  explicit BoxSides(const CylinderInBoxFrame& p) : face(best_face(p)), edge(best_edge(p)) {
    // Component by component: Eigen would load in pairs what was just stored singly, which stalls.
    const double along = p.d[0] * p.u[0] + p.d[1] * p.u[1] + p.d[2] * p.u[2];
    cap = std::abs(along) - p.h - p.e[0] * std::abs(p.u[0]) - p.e[1] * std::abs(p.u[1]) -
          p.e[2] * std::abs(p.u[2]);
    cap_side = std::copysign(1, along);
  }
  /// Of the best of all.
  Kind kind() const {
    if (edge.gap > face.gap && edge.gap > cap) return Kind::edge;
    return cap > face.gap ? Kind::cap : Kind::face;
  }
  /// The proof is left out where the gap is above `stop_above`. Of a face whose gap is less by
  /// rounding only it is as good.
  StageResult best(const CylinderInBoxFrame& p, double stop_above) const {
    StageResult found = best_of_kind(p, stop_above);
    const double lengths = p.lengths();
    if (!found.is_proven && found.gap <= stop_above && kind() != Kind::face &&
        found.gap - face.gap <= tie_part * lengths) {
      found.is_proven = is_proven(face, p);
    }
    return found;
  }

 private:
  StageResult best_of_kind(const CylinderInBoxFrame& p, double stop_above) const {
    switch (kind()) {
      case Kind::edge: {
        const Vec3 n = edge.normal(p.u);
        return {edge.gap, n.x(), n.y(), n.z(), edge.gap <= stop_above && is_proven(edge, p)};
      }
      case Kind::cap: {
        const Vec3 n = cap_side * p.u;
        return {cap, n.x(), n.y(), n.z(), cap <= stop_above && is_proven_at_cap(p, cap, n)};
      }
      default: {
        const Vec3 n = std::copysign(1, p.d[face.axis]) * Vec3::Unit(face.axis);
        return {face.gap, n.x(), n.y(), n.z(), face.gap <= stop_above && is_proven(face, p)};
      }
    }
  }
};

}  // namespace touchstone
