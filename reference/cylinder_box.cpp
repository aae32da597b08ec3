#include "cylinder_box.hpp"

#include <cmath>
#include <limits>

#include "ellipse_normal.hpp"
#include "largest_gap.hpp"
#include "pair_contact.hpp"
#include "quick_separation.hpp"
#include "scaled.hpp"

namespace touchstone {
namespace {

// In the box's frame. The bodies touch at a face, at a cap, where an edge crosses the side, at the
// side (a vertex beside it), where an edge crosses a rim (a point against an ellipse, seen along
// the edge) or, only apart, with a vertex off the rim. The first three kinds, seven directions, are
// tried first. Most of the time their best is final, because a smooth place of one body is met well
// within its bounds: where the bodies overlap by δ, a ball of radius δ fits into the cylinder or
// box behind that place, so that no way out is shorter than δ.
class Solver {
 public:
  Solver(const Cylinder& a, const Box& b, const Vec3& d, const Vec3& u)
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
    const int face = faces();
    const double face_gap = best_.gap;
    const bool cap_wins = cap();
    const double cap_gap = best_.gap;
    const int edge = edges_across_side();
    if (best_.gap > enough) return true;
    if (best_.gap > cap_gap) return edge_is_final(edge);
    return cap_wins ? cap_is_final() : face_gap == best_.gap && face_is_final(face);
  }
  void search() {
    vertices();
    if (final_) return;
    for (int i = 0; i < 3; ++i) edge_over_rim(i);
  }
  const LargestGap& best() const { return best_; }

 private:
  double depth() const { return std::max(0.0, -best_.gap); }

  int faces() {
    int best = 0;
    for (int i = 0; i < 3; ++i) {
      const double gap = std::abs(d_[i]) - e_[i] - h_ * std::abs(u_[i]) - r_ * s_[i];
      if (gap <= best_.gap) continue;
      best_.gap = gap;
      best = i;
    }
    best_.normal = std::copysign(1, d_[best]) * Vec3::Unit(best);
    return best;
  }

  bool cap() {
    const double along = d_.dot(u_);
    const double gap = std::abs(along) - h_ - e_.dot(u_.cwiseAbs());
    if (gap <= best_.gap) return false;
    best_.offer(gap, std::copysign(1, along) * u_);
    return true;
  }

  /// n = e × u. Returns the edge's direction if it is the best.
  int edges_across_side() {
    int best = -1;
    for (int i = 0; i < 3; ++i) {
      if (!(s_[i] > 0)) continue;
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double along = d_[k] * u_[j] - d_[j] * u_[k];
      const double gap =
          (std::abs(along) - e_[j] * std::abs(u_[k]) - e_[k] * std::abs(u_[j])) / s_[i] - r_;
      if (gap <= best_.gap) continue;
      const double scale = std::copysign(1 / s_[i], along);
      Vec3 n;
      n[i] = 0, n[j] = -u_[k] * scale, n[k] = u_[j] * scale;
      best_.offer(gap, n);
      best = i;
    }
    return best;
  }

  /// A point of A that faces the box lies on the face, its depth away from the edges.
  bool face_is_final(int i) const {
    const double delta = depth();
    if (delta > e_[i]) return false;
    const double side = std::copysign(1, d_[i]);
    // A generator or cap that lies on the face offers its middle.
    constexpr double flat = 1e-15;
    const double along = side * u_[i];
    const double end = std::abs(along) > flat ? -std::copysign(h_, along) : 0;
    const double rim = s_[i] > flat ? r_ / s_[i] : 0;
    for (int m = 1; m < 3; ++m) {
      const int j = (i + m) % 3;
      const double x = d_[j] + end * u_[j] + rim * along * u_[j];
      if (std::abs(x) > e_[j] - delta) return false;
    }
    return true;
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
  bool edge_is_final(int i) const {
    const double delta = depth();
    if (delta > r_) return false;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3& n = best_.normal;
    const double y = std::copysign(e_[j], n[j]) - d_[j], z = std::copysign(e_[k], n[k]) - d_[k];
    // Along m = (u_j, u_k)/s, across n and the edge.
    const double alpha = (y * u_[j] + z * u_[k]) / (s_[i] * s_[i]);
    return std::abs(alpha) <= h_ - delta && std::abs(d_[i] + alpha * u_[i]) <= e_[i];
  }

  /// Beside the side (n ⟂ u) and, for the nearest vertex only, off the rim.
  void vertices() {
    // A vertex is a sum of half edges, so are its place along the axis and that across.
    const double d_along = d_.dot(u_);
    const Vec3 d_across = d_ - d_along * u_;
    const Vec3 along = e_.cwiseProduct(u_);
    Eigen::Matrix3d across_of;
    for (int i = 0; i < 3; ++i) across_of.col(i) = e_[i] * Vec3::Unit(i) - along[i] * u_;

    // Along an edge that is parallel to the axis, what is across is rounding of either sign.
    const double noise = -1e-15 * (d_.cwiseAbs().sum() + e_.sum());
    double nearest = std::numeric_limits<double>::infinity();
    Vec3 off_rim = Vec3::Zero();
    for (int corner = 0; corner < 8; ++corner) {
      const double x = (corner & 1) ? 1 : -1, y = (corner & 2) ? 1 : -1, z = (corner & 4) ? 1 : -1;
      const double height = d_along - x * along[0] - y * along[1] - z * along[2];
      const Vec3 across =
          d_across - x * across_of.col(0) - y * across_of.col(1) - z * across_of.col(2);
      const double squared = across.squaredNorm(), above = std::abs(height) - h_;
      const double bound = best_.gap + r_;
      if (x * across[0] >= noise && y * across[1] >= noise && z * across[2] >= noise &&
          squared > 0 && !(bound > 0 && squared <= bound * bound)) {
        // What rounding leaves along the axis counts over its whole length.
        const double radial = std::sqrt(squared);
        Vec3 n = across / radial;
        n = (n - n.dot(u_) * u_).normalized();
        const bool pointed = x * n[0] >= 0 && y * n[1] >= 0 && z * n[2] >= 0;
        best_.offer(pointed ? radial - r_ : gap(n), n);
        final_ = pointed && std::abs(height) <= h_ - depth() && depth() <= r_;
      }
      if (above > 0 && squared > r_ * r_ && above * above < nearest) {
        const double radial = std::sqrt(squared), beside = radial - r_;
        if (above * above + beside * beside >= nearest) continue;
        nearest = above * above + beside * beside;
        off_rim = std::copysign(above, height) * u_ + (beside / radial) * across;
      }
    }
    if (nearest < std::numeric_limits<double>::infinity() && !final_) {
      const Vec3 n = off_rim.normalized();
      best_.offer(gap(n), n);
    }
  }

  double gap(const Vec3& n) const {
    return d_.dot(n) - e_.dot(n.cwiseAbs()) - h_ * std::abs(u_.dot(n)) - r_ * u_.cross(n).norm();
  }

  /// n ⟂ edge i. Seen along the edge, the sum of box and axis is a polygon; on each of its corners
  /// sits the cap's ellipse, with half axes r across the axis and r |u_i| along it.
  void edge_over_rim(int i) {
    if (!(s_[i] > 0)) return;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec2 along(u_[j] / s_[i], u_[k] / s_[i]), across(-along.y(), along.x());
    const double lean = h_ * s_[i], b = r_ * std::abs(u_[i]);
    // Inside the polygon, no direction is better than its edges less the ellipse's inscribed disc.
    const double aside = across.x() * d_[j] + across.y() * d_[k];
    const double polygon =
        std::max({std::abs(d_[j]) - e_[j] - h_ * std::abs(u_[j]),
                  std::abs(d_[k]) - e_[k] - h_ * std::abs(u_[k]),
                  std::abs(aside) - e_[j] * std::abs(across.x()) - e_[k] * std::abs(across.y())});
    if (polygon <= 0 && polygon - b <= best_.gap) return;
    for (int corner = 0; corner < 4; ++corner) {
      const Vec2 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1);
      const Vec2 p(d_[j] - sign.x() * e_[j], d_[k] - sign.y() * e_[k]);
      for (const double end : {1.0, -1.0}) {
        const Vec2 q = p - end * lean * along;
        // n points away from the corner, so that only what of q does so counts.
        const Vec2 out = q.cwiseProduct(sign).cwiseMax(0.0);
        const double bound = best_.gap + b;
        if (bound >= 0 && out.squaredNorm() <= bound * bound) continue;
        const double x = std::abs(across.dot(q)), y = end * along.dot(q);
        const Vec2 x_axis = std::copysign(1, across.dot(q)) * across, y_axis = end * along;
        // The corner's quadrant of normals and the ellipse's must overlap.
        if (!((x_axis + y_axis).dot(sign) > 0)) continue;
        // A point inside may be too far behind the chord of the ellipse's quadrant.
        if (r_ * b - b * x - r_ * y >= std::max(0.0, -best_.gap) * (r_ + b)) continue;
        const auto foot = ellipse_normal(r_, b, x, y);
        if (!foot) continue;
        const Vec2 n2 = foot->x() * x_axis + foot->y() * y_axis;
        Vec3 n;
        n[i] = 0, n[j] = n2.x(), n[k] = n2.y();
        const double value =
            d_[j] * n2.x() + d_[k] * n2.y() - e_[j] * std::abs(n2.x()) - e_[k] * std::abs(n2.y()) -
            lean * foot->y() -
            std::sqrt(r_ * r_ * foot->x() * foot->x() + b * b * foot->y() * foot->y());
        best_.offer(value, n);
      }
    }
  }

  using Vec2 = Eigen::Vector2d;

  double r_, h_;
  const Vec3& e_;
  const Vec3 d_, u_;
  Vec3 s_;  ///< sines of the angles between u and the edges
  LargestGap best_;
  bool final_ = false;
};

/// Stops at the first direction with a clearance of more than `enough`.
SignedDistance solve(const Cylinder& a, const Box& b, const PosedCylinder& posed_a,
                     const PosedBox& posed_b, double enough) {
  const Eigen::Matrix3d& axes = posed_b.axes;
  Solver solver(a, b, axes.transpose() * posed_a.centre, axes.transpose() * posed_a.axis);
  if (!solver.closed_forms(enough)) {
    SignedDistance clearance;
    if (quickly_separated(posed_a, posed_b, enough, clearance)) return clearance;
    solver.search();
  }
  return {solver.best().gap, axes * solver.best().normal};
}

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                               const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return signed_distance(bodies...); }));
  }
  const Vec3& origin = pose_b.position();
  return solve(a, b, posed(a, pose_a, origin), posed(b, pose_b, origin), never);
}

bool overlaps(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.ask([](const auto&... bodies) { return overlaps(bodies...); });
  }
  const Vec3& origin = pose_b.position();
  const PosedCylinder posed_a = posed(a, pose_a, origin);
  const PosedBox posed_b = posed(b, pose_b, origin);
  return solve(a, b, posed_a, posed_b, 0).value <= 0;
}

Contact contact(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal) {
  Contact result;
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    result = scaled.back(scaled.ask([&](const auto&... bodies) {
      return contact(bodies..., scaled.scaled(contact_threshold), previous_normal);
    }));
    return result;
  }
  const Vec3& origin = pose_b.position();
  const PosedCylinder posed_a = posed(a, pose_a, origin);
  const PosedBox posed_b = posed(b, pose_b, origin);
  const SignedDistance found = solve(a, b, posed_a, posed_b, contact_threshold);
  make_contact(result, posed_a, posed_b, found, contact_threshold, origin, previous_normal);
  return result;
}

}  // namespace touchstone
