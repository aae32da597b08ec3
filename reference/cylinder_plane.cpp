#include <array>
#include <cmath>

#include "closed_forms.hpp"
#include "disc_layout.hpp"
#include "facing_feature.hpp"
#include "manifold.hpp"
#include "pair.hpp"

// The only normal is the plane's, and the signed distance that of the deepest point, on the rim of
// the lower cap (closed_forms.hpp). The points are, in this order,
//
//   cap_on_plane        of a cylinder that stands: on the cap's rim
//   generator_on_plane  of one that lies: the ends of the lowest generator
//   rim_on_plane        of any other: the deepest point

namespace touchstone {
namespace {

class PlaneRoutine {
 public:
  PlaneRoutine(const PosedCylinder& a, const PosedPlane& b)
      : a_(a), normal_(b.normal), over_(a, b) {}

  SignedDistance find(double) const { return {over_.distance(a_), normal_}; }
  CertifiedDistance find_certified() const { return {find(no_early_exit), 0}; }

  void add_points(Contact& contact, const Vec3& origin, double contact_threshold,
                  PointRange range) const {
    const Extents size = extents(a_);
    const Margins margins(size, size, std::abs(over_.height), contact.signed_distance,
                          contact_threshold, range);
    const auto add = [&](double x, double y, double z, double height) {
      const Vec3 arm = x * a_.axes.col(0) + y * a_.axes.col(1) + z * a_.axes.col(2);
      contact.add_point(origin + (a_.centre + (arm - height / 2 * normal_)), -height);
    };
    if (const double part = facing_part(a_.radius, over_.sine, margins.slack); part > 0) {
      return cap_on_plane(margins, part, add);
    }
    if (const double part = facing_part(a_.half_length, over_.cosine, margins.slack); part > 0) {
      return generator_on_plane(margins.slack, part, add);
    }
    rim_on_plane(contact.signed_distance, add);
  }

 private:
  // Each calls add(x, y, z, height) with points of the surface in the cylinder's frame and their
  // heights above the plane.

  /// The first point is where the cylinder's own x axis meets the rim: the plane looks alike all
  /// around.
  template <class Add>
  void cap_on_plane(const Margins& margins, double part, Add add) const {
    const double z = lower_end();
    std::array<Vec2, 6> arms;
    const int count = spread_disc(a_.radius, Vec2(over_.x, over_.y), Vec2(1, 0), margins.slack,
                                  margins.clear_rise(), arms);
    if (part < 1) {
      const Vec2 lowest = lowest_arm();
      for (int i = 0; i < count; ++i) arms[i] = lowest + part * (arms[i] - lowest);
    }
    for (int i = 0; i < count; ++i) add(arms[i].x(), arms[i].y(), z, height(arms[i], z));
  }
  /// The ends of the lowest generator in the order of the axis; instead of the higher one, where
  /// the generator rises above the slack, the point where it does.
  template <class Add>
  void generator_on_plane(double slack, double part, Add add) const {
    const Vec2 arm = lowest_arm();
    const double low = lower_end(), rise = 2 * a_.half_length * std::abs(over_.cosine);
    const double high = rise > slack ? low * (1 - 2 * part * slack / rise) : -low;
    for (const double z : {std::min(low, high), std::max(low, high)}) {
      add(arm.x(), arm.y(), z, height(arm, z));
    }
  }
  template <class Add>
  void rim_on_plane(double signed_distance, Add add) const {
    const Vec2 arm = lowest_arm();
    add(arm.x(), arm.y(), lower_end(), signed_distance);
  }

  double lower_end() const { return -std::copysign(a_.half_length, over_.cosine); }
  Vec2 lowest_arm() const { return (-a_.radius / over_.sine) * Vec2(over_.x, over_.y); }
  double height(const Vec2& arm, double z) const {
    return over_.height + arm.x() * over_.x + arm.y() * over_.y + z * over_.cosine;
  }

  const PosedCylinder& a_;
  const Vec3& normal_;  ///< the plane's, towards the cylinder's side
  OverPlane over_;
};

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                               const Pose& pose_b) {
  return find_signed_distance<PlaneRoutine>(a, pose_a, b, pose_b);
}
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                                     const Pose& pose_b) {
  return find_certified_distance<PlaneRoutine>(a, pose_a, b, pose_b);
}
bool overlaps(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b) {
  return find_overlap<PlaneRoutine>(a, pose_a, b, pose_b);
}
Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal, PointRange range) {
  return find_contact<PlaneRoutine>(a, pose_a, b, pose_b, contact_threshold, previous_normal,
                                    range);
}

}  // namespace touchstone
