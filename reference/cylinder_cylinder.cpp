#include "cylinder_cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "deep_normals.hpp"
#include "ellipse_normal.hpp"
#include "largest_gap.hpp"
#include "pair_contact.hpp"
#include "rim_rim.hpp"
#include "scaled.hpp"

namespace touchstone {
namespace {

// In the folded frame the bodies touch at a cap, where the sides cross, at a side (the other's rim
// beside it: a point against an ellipse, seen along the side), or rim to rim. All but the last have
// one candidate each, and the best of them is mostly final, because a smooth place of one body is
// met well within its bounds: where the bodies overlap by δ, a ball of radius δ fits into that body
// behind the place, so that no way out is shorter than δ; deeper ones are bounded in
// deep_normals.hpp. Else the rims are scanned (rim_rim.hpp).
class Solver {
 public:
  Solver(const PosedCylinder& a, const PosedCylinder& b)
      : pair_{FoldedAxes(a.axis, b.axis, a.centre), a.radius, a.half_length, b.radius,
              b.half_length} {}

  /// Caps and crossing sides. True if they say it all, or a gap of more than `enough` is found.
  bool closed_forms(double enough) {
    const double along2 = f_.along_u2(f_.d());
    const double cap1 = std::abs(f_.d1) - pair_.h1 - pair_.h2 * f_.c - pair_.r2 * f_.s;
    const double cap2 = std::abs(along2) - pair_.h2 - pair_.h1 * f_.c - pair_.r1 * f_.s;
    const double crossing = f_.d3 - pair_.r1 - pair_.r2;
    best_.gap = std::max(std::max(cap1, cap2), crossing);
    const double side = std::copysign(1, along2);
    if (best_.gap > enough) {
      // Which it is nobody can foretell, so a branch would cost more.
      const double is1 = best_.gap == cap1 ? 1 : 0, is3 = best_.gap == crossing ? 1 - is1 : 0;
      const double is2 = side * (1 - is1 - is3);
      best_.normal = Vec3(std::copysign(is1, f_.d1) + is2 * f_.c, is2 * f_.s, is3);
      return true;
    }
    if (best_.gap == cap1) {
      best_.normal = Vec3(std::copysign(1, f_.d1), 0, 0);
      is_final_ = &Solver::cap1_is_final;
    } else if (best_.gap == cap2) {
      best_.normal = Vec3(side * f_.c, side * f_.s, 0);
      is_final_ = &Solver::cap2_is_final;
    } else {
      best_.normal = Vec3(0, 0, 1);
      is_final_ = &Solver::crossing_is_final;
    }
    return (this->*is_final_)() || (enough < never && apart_beside(enough));
  }
  /// Rims beside sides, and rims.
  void search(double enough) {
    better(&Solver::rim2_beside_side1, &Solver::side1_is_final);
    if (best_.gap > enough) return;
    better(&Solver::rim1_beside_side2, &Solver::side2_is_final);
    if (best_.gap > enough || (this->*is_final_)()) return;
    offer_rim_rim_normals(pair_, enough, best_);
  }
  /// Tries every normal, and returns by how much the largest gap may exceed the best one.
  double exhaust() {
    closed_forms(never);
    rim2_beside_side1();
    rim1_beside_side2();
    return search_all_rims(pair_, best_) + rounding_part * pair_.lengths();
  }
  const LargestGap& best() const { return best_; }
  Vec3 to_world(const Vec3& n) const { return f_.to_world(n); }

 private:
  using Certificate = bool (Solver::*)() const;

  /// Whether a normal from one side to the nearest end of the other axis has a gap of more than
  /// `enough`: mostly, where bodies are apart by more than a little.
  bool apart_beside(double enough) {
    const double y1 = std::abs(f_.d2) - pair_.h2 * f_.s;
    const double along = f_.along_k2(f_.d()), y2 = std::abs(along) - pair_.h1 * f_.s;
    if (far_beside(y1, pair_.r1, pair_.r2, enough)) {
      const Eigen::Vector2d n = towards(y1, pair_.r2);
      if (is_apart(Vec3(0, std::copysign(n.y(), f_.d2), n.x()), enough)) return true;
    }
    if (far_beside(y2, pair_.r2, pair_.r1, enough)) {
      const Eigen::Vector2d n = towards(y2, pair_.r1);
      const double side = std::copysign(n.y(), along);
      return is_apart(Vec3(-f_.s * side, f_.c * side, n.x()), enough);
    }
    return false;
  }
  /// The other's end lies y across the side within the plane of the axes, and d3 off it.
  bool far_beside(double y, double side, double rim, double enough) const {
    const double least = enough + side + rim * f_.c;
    return y > 0 && y * y + f_.d3 * f_.d3 > least * least;
  }
  /// About the way to the nearest point of the end, which is an ellipse as seen along the side.
  Eigen::Vector2d towards(double y, double rim) const {
    const double distance = std::sqrt(y * y + f_.d3 * f_.d3);
    const double b = rim * f_.c, tau = rim * std::max(0.0, distance - rim);
    const Eigen::Vector2d n((b * b + tau) * f_.d3, (rim * rim + tau) * y);
    return (1 / n.norm()) * n;
  }
  bool is_apart(const Vec3& n, double enough) {
    const double gap = pair_.gap(n);
    if (!(gap > enough + pair_.clear_gap())) return false;
    best_ = {gap, n};
    return true;
  }

  double depth() const { return std::max(0.0, -best_.gap); }

  /// Offers a candidate; if it is the best, its certificate counts.
  void better(void (Solver::*candidate)(), Certificate certificate) {
    const double before = best_.gap;
    (this->*candidate)();
    if (best_.gap > before) is_final_ = certificate;
  }

  /// A point of cylinder 2 that faces cap 1 lies on it.
  bool cap1_is_final() const {
    const double side = best_.normal.x();
    const AboutAxis about{
        pair_.r1, pair_.h1, pair_.r2,        pair_.h2,
        f_.c,     f_.s,     std::abs(f_.d1), std::sqrt(f_.d2 * f_.d2 + f_.d3 * f_.d3)};
    return on_cap(f_.d2, side, about);
  }
  bool cap2_is_final() const {
    const double side = f_.along_u2(best_.normal);
    // Seen from u2, u1 leans the other way.
    const double along = f_.along_u2(f_.d()), across = f_.along_k2(f_.d());
    const AboutAxis about{
        pair_.r2, pair_.h2, pair_.r1,        pair_.h1,
        f_.c,     f_.s,     std::abs(along), std::sqrt(across * across + f_.d3 * f_.d3)};
    return on_cap(-across, side, about);
  }
  /// The other's centre lies at `offset` across the cap's axis, the middle of its rim towards the
  /// cap's `side` at H s from there, and the rim's point at another −R c.
  bool on_cap(double offset, double side, const AboutAxis& x) const {
    const double delta = depth();
    constexpr double flat = 1e-15;
    double across = 0, reach = x.r - delta;
    if (x.s <= flat) {  // cap on cap: any shared point
      across = offset;
      reach += x.R;
    } else if (x.c <= flat) {  // a generator on the cap: any of its points
      across = std::max(0.0, std::abs(offset) - x.H);
    } else {
      across = offset - side * (x.H * x.s - x.R * x.c);
    }
    const double squared = across * across + f_.d3 * f_.d3;
    // Its depth away from the cap's rim.
    if (delta <= x.h && delta <= x.r && squared <= reach * reach) return true;
    if (best_.gap > 0) return false;
    if (no_normal_beats_cap(x, delta)) return true;
    return squared <= x.r * x.r && x.s > flat &&
           bends_away_near_axis({x.R, x.H}, {x.r, x.h}, x.s, f_.d3 * f_.d3 / squared, delta, 0, x);
  }

  /// The generators cross within both, one of them further from its ends than the depth.
  bool crossing_is_final() const {
    const double delta = depth();
    constexpr double flat = 1e-15;
    if (f_.s <=
        flat) {  // side by side, e3 through both axes: any generator's point that they share
      return std::abs(f_.d2) <= flat * f_.d3 &&
             on_side(std::max(0.0, std::abs(f_.d1) - pair_.h2), pair_.r1, pair_.h1);
    }
    const auto [t1, t2] = f_.crossing();
    if (std::abs(t1) > pair_.h1 || std::abs(t2) > pair_.h2) return false;
    return (std::abs(t1) <= pair_.h1 - delta && delta <= pair_.r1) ||
           (std::abs(t2) <= pair_.h2 - delta && delta <= pair_.r2) ||
           no_normal_beats_crossing(pair_);
  }

  /// n = (0, n_y, n_x): across side 1, seen along u1.
  void rim2_beside_side1() {
    const double y = std::abs(f_.d2) - pair_.h2 * f_.s;
    const auto n = beside(y, pair_.r2, pair_.r1);
    if (n) offer(Vec3(0, std::copysign(n->y(), f_.d2), n->x()));
  }
  void rim1_beside_side2() {
    const double along = f_.along_k2(f_.d());
    const double y = std::abs(along) - pair_.h1 * f_.s;
    const auto n = beside(y, pair_.r1, pair_.r2);
    if (!n) return;
    const double side = std::copysign(n->y(), along);
    offer(Vec3(-f_.s * side, f_.c * side, n->x()));
  }
  std::optional<Eigen::Vector2d> beside(double y, double rim, double side) const {
    // No direction is better than the distance from the ellipse's inscribed disc.
    const double b = rim * f_.c, bound = best_.gap + side + b;
    if (bound > 0 && f_.d3 * f_.d3 + y * y <= bound * bound) return std::nullopt;
    // A point inside may be too far behind the chord of the ellipse's quadrant.
    if (rim * b - b * f_.d3 - rim * y >= std::max(0.0, -best_.gap - side) * (rim + b))
      return std::nullopt;
    return ellipse_normal(rim, b, f_.d3, y);
  }
  void offer(const Vec3& n) { best_.offer(pair_.gap(n), n); }

  /// The rim's point lies on the side, its depth away from the ends.
  bool side1_is_final() const {
    return on_side(pair_.along_axis1(best_.normal), pair_.r1, pair_.h1);
  }
  bool side2_is_final() const {
    return on_side(pair_.along_axis2(best_.normal), pair_.r2, pair_.h2);
  }
  bool on_side(double along, double r, double h) const {
    const double delta = depth();
    return std::abs(along) <= h - delta && delta <= r;
  }

  FoldedCylinders pair_;
  const FoldedAxes& f_ = pair_.axes;
  LargestGap best_;
  Certificate is_final_ = &Solver::cap1_is_final;
};

/// Stops at the first direction with a clearance of more than `enough`. `a` has the smaller radius
/// or the same.
SignedDistance solve(const PosedCylinder& a, const PosedCylinder& b, double enough) {
  Solver solver(a, b);
  if (!solver.closed_forms(enough)) solver.search(enough);
  return {solver.best().gap, solver.to_world(solver.best().normal)};
}

/// A fixed order of bodies, so that the answer does not depend on which comes first.
bool in_order(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b) {
  if (a.radius() != b.radius()) return a.radius() < b.radius();
  if (a.half_length() != b.half_length()) return a.half_length() < b.half_length();
  const auto key = [](const Pose& p) {
    const auto& q = p.orientation();
    return std::make_tuple(p.position().x(), p.position().y(), p.position().z(), q.w(), q.x(),
                           q.y(), q.z());
  };
  return key(pose_a) <= key(pose_b);
}

/// The bodies in that order, in a frame about the second one.
struct Ordered {
  bool swapped;
  const Vec3& origin;
  PosedCylinder a, b;

  Ordered(const Cylinder& first, const Pose& pose1, const Cylinder& second, const Pose& pose2)
      : swapped(!in_order(first, pose1, second, pose2)),
        origin(swapped ? pose1.position() : pose2.position()),
        a(posed(swapped ? second : first, swapped ? pose2 : pose1, origin)),
        b(posed(swapped ? first : second, swapped ? pose1 : pose2, origin)) {}

  SignedDistance solve(double enough) const { return touchstone::solve(a, b, enough); }
  /// Of a normal between the bodies as they were given.
  double sign() const { return swapped ? -1 : 1; }
};

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                               const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return signed_distance(bodies...); }));
  }
  const Ordered bodies(a, pose_a, b, pose_b);
  SignedDistance found = bodies.solve(never);
  found.normal *= bodies.sign();
  return found;
}

CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                                     const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return certified_distance(bodies...); }));
  }
  const Ordered bodies(a, pose_a, b, pose_b);
  Solver solver(bodies.a, bodies.b);
  const double error_bound = solver.exhaust();
  return {{solver.best().gap, bodies.sign() * solver.to_world(solver.best().normal)}, error_bound};
}

bool overlaps(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.ask([](const auto&... bodies) { return overlaps(bodies...); });
  }
  return Ordered(a, pose_a, b, pose_b).solve(0).value <= 0;
}

Contact contact(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal) {
  Contact result;
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    result = scaled.back(scaled.ask([&](const auto&... bodies) {
      return contact(bodies..., scaled.scaled(contact_threshold), previous_normal);
    }));
    return result;
  }
  const Ordered bodies(a, pose_a, b, pose_b);
  Vec3 previous;
  if (previous_normal) previous = bodies.sign() * *previous_normal;
  make_contact(result, bodies.a, bodies.b, bodies.solve(contact_threshold), contact_threshold,
               bodies.origin, previous_normal ? &previous : nullptr);
  result.normal *= bodies.sign();
  return result;
}

}  // namespace touchstone
