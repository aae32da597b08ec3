#include "cylinder_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "box_sides.hpp"
#include "circle.hpp"
#include "deep_normals.hpp"
#include "ellipse_normal.hpp"
#include "largest_gap.hpp"
#include "pair_contact.hpp"
#include "posed_body.hpp"
#include "scaled.hpp"

namespace touchstone {
namespace {

// In the box's frame. The bodies touch at a face, at a cap, where an edge crosses the side, at the
// side (a vertex beside it), where an edge crosses a rim (a point against an ellipse, seen along
// the edge) or, only apart, with a vertex off the rim. The first three kinds are BoxSides', which
// mostly prove themselves; here are the others. Of edges and rims the likely one is tried first,
// and mostly proves itself, too.
class Solver : public BoxSides {
 public:
  using BoxSides::BoxSides;

  /// The other directions, up to one that has a gap of more than `enough`.
  void search(double enough) {
    vertices_beside_side();
    if (final_ || best_.gap > enough) return;
    // As deep in each other as this, bodies hardly ever come free where a rim meets an edge.
    constexpr double deep = 0.3;
    if (depth() < deep * (std::min(r_, h_) + e_.minCoeff())) likely_edge_over_rim();
    if (final_ || best_.gap > enough) return;
    const bool meet = meet_between();
    if (best_.gap > enough) return;
    if (!meet) vertex_off_rim();
    for (int i = 0; i < 3 && !final_ && best_.gap <= enough; ++i) edge_over_rim(i);
  }

  /// Tries every normal.
  void exhaust() {
    closed_forms(never);
    for (int i = 0; i < 8; ++i) vertex_beside_side(corner(i));
    meet_between();
    vertex_off_rim();
    for (int i = 0; i < 3; ++i) edge_over_rim(i);
  }

 private:
  /// n ⟂ u. Seen along the axis the box is a polygon, and where one of its corners is the nearest
  /// to the axis, one of the two sides there is the furthest away: a corner's clearance times the
  /// cosine of the angle to it is that of a side there, and no other side has a smaller angle.
  void vertices_beside_side() {
    // Sides of about one direction, or of no length, cannot be told apart.
    constexpr double flat = 0.01;
    if (u_.cwiseAbs().minCoeff() > flat) {
      if (!(side_gap_ + r_ > 0)) return;  // the axis passes through the polygon
      const Crossing c = crossing();
      if (std::abs(c.along_edge) > e_[side_]) vertex_beside_side(c.corner);
    } else {
      for (int i = 0; i < 8; ++i) vertex_beside_side(corner(i));
    }
  }
  void vertex_beside_side(const Vec3& v) {
    const Vec3 arm = d_ - v;
    const double height = arm.dot(u_);
    const Vec3 across = arm - height * u_;
    const double squared = across.squaredNorm(), bound = best_.gap + r_;
    if (!(squared > 0) || (bound > 0 && squared <= bound * bound)) return;
    // Along an edge that is parallel to the axis, what is across is rounding of either sign.
    const double noise = -1e-15 * (d_.cwiseAbs().sum() + e_.sum());
    if ((v.cwiseProduct(across).array() < noise * e_.array()).any()) return;
    // What rounding leaves along the axis counts over its whole length.
    const double radial = std::sqrt(squared);
    Vec3 n = across / radial;
    n -= n.dot(u_) * u_;
    const double length = n.norm();
    if (!(length > 0.5)) return;  // the vertex is on the axis, but for rounding
    n /= length;
    const bool pointed = (v.cwiseProduct(n).array() >= 0).all();
    best_.offer(pointed ? radial - r_ : gap(n), n);
    final_ = pointed && std::abs(height) <= h_ - depth() && depth() <= r_;
  }
  Vec3 corner(int i) const {
    return {(i & 1) ? e_[0] : -e_[0], (i & 2) ? e_[1] : -e_[1], (i & 4) ? e_[2] : -e_[2]};
  }

  /// Projects A's centre onto the box, that point onto A and that onto the box again (von Neumann's
  /// alternating projections; more seldom help). True if the bodies meet there; otherwise the
  /// direction between the last two points is tried.
  bool meet_between() {
    const Vec3 arm = d_ - d_.cwiseMax(-e_).cwiseMin(e_);
    const double height = arm.dot(u_);
    const Vec3 across = arm - height * u_;
    const double squared = across.squaredNorm();
    const double scale = squared > r_ * r_ ? r_ / std::sqrt(squared) : 1;
    const Vec3 on_a = d_ - std::clamp(height, -h_, h_) * u_ - scale * across;
    const Vec3 apart = on_a - on_a.cwiseMax(-e_).cwiseMin(e_);
    const double distance = apart.norm();
    if (!(distance > 0)) return true;
    // These points may still be far from the nearest ones, but if they are close, so are the
    // bodies.
    constexpr double small_part = 0.02;
    if (distance > small_part * r_) {
      const Vec3 n = (1 / distance) * apart;
      best_.offer(gap(n), n);
    }
    return false;
  }

  /// Between bodies that are apart: the nearest vertex that is off the rim.
  void vertex_off_rim() {
    // Across the axis and along it, from the vertices to A's centre: the centre's part less that of
    // each half extent. (Squares that cancel would hide a thin body's radius.)
    const double along = d_.dot(u_);
    const Vec3 across = d_ - along * u_;
    std::array<Vec3, 3> side;
    for (int i = 0; i < 3; ++i) side[i] = e_[i] * (Vec3::Unit(i) - u_[i] * u_);
    double nearest = std::numeric_limits<double>::infinity();
    int best = -1;
    for (int i = 0; i < 8; ++i) {  // without branches, which nobody can predict
      const double x = (i & 1) ? 1 : -1, y = (i & 2) ? 1 : -1, z = (i & 4) ? 1 : -1;
      const double height = along - x * e_[0] * u_[0] - y * e_[1] * u_[1] - z * e_[2] * u_[2];
      const double radial = (across - x * side[0] - y * side[1] - z * side[2]).norm();
      const double above = std::abs(height) - h_, beside = radial - r_;
      const double distance = above * above + beside * beside;
      const bool better = (above > 0) & (beside > 0) & (distance < nearest);
      nearest = better ? distance : nearest;
      best = better ? i : best;
    }
    if (best < 0) return;
    const Vec3 arm = d_ - corner(best);
    const double height = arm.dot(u_);
    const Vec3 off_axis = arm - height * u_;
    const double radial = off_axis.norm();
    // Computed anew, what was above or beside by rounding alone may not be so.
    const double above = std::max(std::abs(height) - h_, 0.0), beside = std::max(radial - r_, 0.0);
    if (!(above > 0 || beside > 0)) return;
    Vec3 off_rim = std::copysign(above, height) * u_;
    if (beside > 0) off_rim += (beside / radial) * off_axis;
    const Vec3 n = off_rim.normalized();
    best_.offer(gap(n), n);
  }

  /// Two chords of the ellipse's quadrant meet at (r, b)/√2: is the point (x, y) further behind
  /// both than the best depth?
  bool is_behind_chords(double b, double x, double y) const {
    constexpr double mid = std::numbers::sqrt2 - 1;
    const double across = r_ * b - b * x - r_ * mid * y, along = r_ * b - b * mid * x - r_ * y;
    const double squared = depth() * depth();
    return across > 0 && across * across >= squared * (b * b + mid * mid * r_ * r_) && along > 0 &&
           along * along >= squared * (r_ * r_ + mid * mid * b * b);
  }

  /// The axis as seen along edge i; unit.
  Vec2 seen_along(int i) const { return Vec2(u_[(i + 1) % 3], u_[(i + 2) % 3]) / s_[i]; }

  /// n ⟂ edge i. Seen along the edge, the sum of box and axis is a polygon; on each of its corners
  /// sits the cap's ellipse, with half axes r across the axis and r |u_i| along it.
  void edge_over_rim(int i) {
    if (!(s_[i] > 0)) return;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec2 along = seen_along(i), across(-along.y(), along.x());
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
        if (is_behind_chords(b, x, y)) continue;
        corner_over_rim(i, along, sign, end, q);
      }
    }
  }
  /// The edge at that corner of the box, seen along it, and the rim at that end, +1 or -1 along the
  /// axis as seen from the box, about which the corner lies at q.
  void corner_over_rim(int i, const Vec2& along, const Vec2& sign, double end, const Vec2& q) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double b = r_ * std::abs(u_[i]), lean = h_ * s_[i];
    const double aside = cross2(along, q);
    const auto foot = ellipse_normal(r_, b, std::abs(aside), end * along.dot(q));
    if (!foot) return;
    const double x = foot->x(), y = foot->y(), x_side = std::copysign(x, aside);
    const Vec2 n(end * y * along.x() - x_side * along.y(),
                 end * y * along.y() + x_side * along.x());
    const double gap = d_[j] * n.x() + d_[k] * n.y() - e_[j] * std::abs(n.x()) -
                       e_[k] * std::abs(n.y()) - lean * y -
                       std::sqrt(r_ * r_ * x * x + b * b * y * y);
    if (!(gap > best_.gap)) return;
    best_.gap = gap;
    best_.normal[i] = 0, best_.normal[j] = n.x(), best_.normal[k] = n.y();
    final_ = n.x() * sign.x() >= 0 && n.y() * sign.y() >= 0 && is_largest(i, *foot, end);
  }

  /// The proof of `bends_away` for a normal at which a rim and edge i meet.
  bool is_largest(int i, const Vec2& foot, double end) const {
    const double nu = end * s_[i] * foot.y();                                          // n·u
    const double squared = foot.x() * foot.x() + u_[i] * u_[i] * foot.y() * foot.y();  // 1 − nu²
    const double at = d_[i] - end * h_ * u_[i] + r_ * nu * u_[i] / std::sqrt(squared);
    const double beyond = e_[i] - std::abs(at);
    return beyond > 0 &&
           bends_away({r_, h_}, {2 * beyond, std::min(e_[(i + 1) % 3], e_[(i + 2) % 3])},
                      u_[i] * u_[i] / squared, depth(), 0);
  }

  /// Where the best of the seven directions fails to prove itself, because the point or the line at
  /// which the bodies would meet lies beyond an edge or a rim.
  void likely_edge_over_rim() {
    Vec3 sign;  // of a vertex
    int i;
    double end;
    if (kind_ == Kind::face) {
      const Vec3 point = facing_face();
      const int j = (face_ + 1) % 3, k = (face_ + 2) % 3;
      i = std::abs(point[j]) - e_[j] > std::abs(point[k]) - e_[k] ? k : j;
      sign = point;
      sign[face_] = d_[face_];
      end = std::copysign(1, d_[face_] * u_[face_]);
    } else if (kind_ == Kind::side) {
      const Crossing c = crossing();
      const double along = std::clamp(c.along_axis, -h_, h_);
      const int j = (side_ + 1) % 3, k = (side_ + 2) % 3;
      sign = c.corner;
      sign[side_] = d_[side_] + along * u_[side_];
      i = std::abs(sign[side_]) <= e_[side_] ? side_ : std::abs(u_[k]) < std::abs(u_[j]) ? j : k;
      end = -std::copysign(1, along);
    } else {
      return;
    }
    // Along an edge across the axis the proof fails.
    constexpr double across = 1e-12;
    if (!(s_[i] > 0 && std::abs(u_[i]) > across)) return;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec2 along = seen_along(i);
    const Vec2 corner(std::copysign(e_[j], sign[j]), std::copysign(e_[k], sign[k]));
    corner_over_rim(i, along, corner, end, Vec2(d_[j], d_[k]) - corner - end * h_ * s_[i] * along);
  }

  bool final_ = false;
};

/// Stops at the first direction with a clearance of more than `enough`.
SignedDistance solve(const Cylinder& a, const Box& b, const PosedCylinder& posed_a,
                     const PosedBox& posed_b, double enough) {
  const Eigen::Matrix3d& axes = posed_b.axes;
  Solver solver(a, b, axes.transpose() * posed_a.centre, axes.transpose() * posed_a.axis);
  if (!solver.closed_forms(enough)) solver.search(enough);
  return {solver.best().gap, axes * solver.best().normal};
}

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

CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                                     const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return certified_distance(bodies...); }));
  }
  const Vec3 d = pose_a.position() - pose_b.position();
  const Eigen::Matrix3d& axes = pose_b.rotation();
  Solver solver(a, b, axes.transpose() * d, axes.transpose() * pose_a.axis());
  solver.exhaust();
  const double lengths = d.cwiseAbs().sum() + a.radius() + a.half_length() + b.half_extents().sum();
  return {{solver.best().gap, axes * solver.best().normal}, rounding_part * lengths};
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
