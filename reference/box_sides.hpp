#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "deep_normals.hpp"
#include "largest_gap.hpp"
#include "shape.hpp"

namespace touchstone {

/// A cylinder and a box in the box's frame, touching at a face, at a cap, or where an edge crosses
/// the side: seven directions. Most of the time their best is final, because a smooth place of one
/// body is met well within its bounds: where the bodies overlap by δ, a ball of radius δ fits into
/// the cylinder or box behind that place, so that no way out is shorter than δ; deeper ones are
/// bounded in deep_normals.hpp.
class BoxSides {
 public:
  /// `d` is the cylinder's centre, `u` its axis.
  BoxSides(const Cylinder& a, const Box& b, const Vec3& d, const Vec3& u)
      : r_(a.radius()),
        h_(a.half_length()),
        e_(b.half_extents()),
        d_(d.unaryExpr([](double x) { return without_vanishing(x); })),
        u_(u.unaryExpr([](double x) { return without_vanishing(x); })) {
    for (int i = 0; i < 3; ++i) {
      const double y = u_[(i + 1) % 3], z = u_[(i + 2) % 3];
      s_[i] = std::sqrt(y * y + z * z);
      constexpr double vanishing = 1e-140;  // its square has lost digits
      if (s_[i] < vanishing) s_[i] = 0;
    }
  }

  /// Seven directions. True if they say it all, or one of them has a gap of more than `enough`.
  bool closed_forms(double enough) {
    face_ = largest_face();
    const double along = d_.dot(u_);
    const double cap_gap = std::abs(along) - h_ - e_.dot(u_.cwiseAbs());
    find_side();
    if (side_gap_ > best_.gap && side_gap_ > cap_gap) {
      kind_ = Kind::side;
      best_ = {side_gap_, side_normal()};
      return best_.gap > enough || side_is_final();
    }
    if (cap_gap > best_.gap) {
      kind_ = Kind::cap;
      best_ = {cap_gap, std::copysign(1, along) * u_};
      return best_.gap > enough || cap_is_final();
    }
    best_.normal = std::copysign(1, d_[face_]) * Vec3::Unit(face_);
    return best_.gap > enough || face_is_final();
  }
  const LargestGap& best() const { return best_; }

 protected:
  double gap(const Vec3& n) const {
    return d_.dot(n) - e_.dot(n.cwiseAbs()) - h_ * std::abs(u_.dot(n)) - r_ * u_.cross(n).norm();
  }

  double depth() const { return std::max(0.0, -best_.gap); }

  /// Where the axis passes the edge of that side.
  struct Crossing {
    double along_axis, along_edge;
    Vec3 corner;  ///< an end of the edge, the nearer one where the axis passes beyond it
  };
  Crossing crossing() const {
    const int i = side_, j = (i + 1) % 3, k = (i + 2) % 3;
    Crossing c;
    c.corner[j] = std::copysign(e_[j], -u_[k] * outwards_);
    c.corner[k] = std::copysign(e_[k], u_[j] * outwards_);
    // Along m = (u_j, u_k)/s, across n and the edge.
    c.along_axis =
        ((c.corner[j] - d_[j]) * u_[j] + (c.corner[k] - d_[k]) * u_[k]) / (s_[i] * s_[i]);
    c.along_edge = d_[i] + c.along_axis * u_[i];
    c.corner[i] = std::copysign(e_[i], c.along_edge);
    return c;
  }

  const double r_, h_;
  const Vec3& e_;
  const Vec3 d_, u_;
  Vec3 s_;  ///< sines of the angles between u and the edges
  LargestGap best_;
  double side_gap_ = -std::numeric_limits<double>::infinity(), outwards_ = 0;
  int side_ = 0, face_ = 0;  ///< the edge of the best side, the axis of the best face
  enum class Kind { face, side, cap } kind_ = Kind::face;  ///< of the best of the seven

  /// Where the point of A that faces that face lies, across it. A generator or cap that lies on it
  /// offers its middle.
  Vec3 facing_face() const {
    const int i = face_;
    constexpr double flat = 1e-15;
    const double along = std::copysign(1, d_[i]) * u_[i];
    const double end = std::abs(along) > flat ? -std::copysign(h_, along) : 0;
    const double rim = s_[i] > flat ? r_ / s_[i] : 0;
    return d_ + (end + rim * along) * u_;
  }

 private:
  int largest_face() {
    int best = 0;
    for (int i = 0; i < 3; ++i) {
      const double gap = std::abs(d_[i]) - e_[i] - h_ * std::abs(u_[i]) - r_ * s_[i];
      if (gap <= best_.gap) continue;
      best_.gap = gap;
      best = i;
    }
    return best;
  }

  /// n = e × u, for the edge e across which the side is the furthest.
  void find_side() {
    for (int i = 0; i < 3; ++i) {
      if (!(s_[i] > 0)) continue;
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double along = d_[k] * u_[j] - d_[j] * u_[k];
      const double gap =
          (std::abs(along) - e_[j] * std::abs(u_[k]) - e_[k] * std::abs(u_[j])) / s_[i] - r_;
      if (gap <= side_gap_) continue;
      side_gap_ = gap, side_ = i, outwards_ = std::copysign(1 / s_[i], along);
    }
  }
  Vec3 side_normal() const {
    const int j = (side_ + 1) % 3, k = (side_ + 2) % 3;
    Vec3 n = Vec3::Zero();
    n[j] = -u_[k] * outwards_, n[k] = u_[j] * outwards_;
    return n;
  }

  /// A point of A that faces the box lies on the face, its depth away from the edges; or a cylinder
  /// about the face's axis is proven for the box, as wide as the centre's distance from the nearest
  /// edge: from there the box reaches at least as far in every direction.
  bool face_is_final() const {
    const double delta = depth();
    const int i = face_, j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 x = facing_face();
    if (delta <= e_[i] && std::abs(x[j]) <= e_[j] - delta && std::abs(x[k]) <= e_[k] - delta) {
      return true;
    }
    const double beside = std::min(e_[j] - std::abs(d_[j]), e_[k] - std::abs(d_[k]));
    return best_.gap < 0 && beside >= 0 &&
           no_normal_beats_cap({beside, e_[i], r_, h_, std::abs(u_[i]), s_[i], std::abs(d_[i]), 0},
                               delta);
  }

  /// A point of B that faces the cap lies on it, its depth away from the rim.
  bool cap_is_final() const {
    const double delta = depth();
    if (delta > h_ || delta > r_) return false;
    Vec3 across;  // from B's point to A's centre
    constexpr double flat = 1e-15;
    for (int i = 0; i < 3; ++i) {
      const double n = best_.normal[i];
      across[i] =
          d_[i] - (std::abs(n) > flat ? std::copysign(e_[i], n) : std::clamp(d_[i], -e_[i], e_[i]));
    }
    across -= across.dot(u_) * u_;
    return across.squaredNorm() <= (r_ - delta) * (r_ - delta);
  }

  /// The edge and the generator cross within both, the generator's ends further than the depth.
  bool side_is_final() const {
    const double delta = depth();
    if (delta > r_) return false;
    const Crossing c = crossing();
    return std::abs(c.along_axis) <= h_ - delta && std::abs(c.along_edge) <= e_[side_];
  }
};

}  // namespace touchstone
