#include "cylinder_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace touchstone {
namespace {

/// The plane in the world: unit normal, and the height of a point above it.
struct WorldPlane {
  Vec3 normal;
  Vec3 origin;
  double displacement;
  WorldPlane(const Plane& plane, const Pose& pose)
      : normal((pose.rotation() * plane.normal()).normalized()),
        origin(pose.position()),
        displacement(plane.displacement() / plane.normal().norm()) {}
  double height(const Vec3& x) const { return normal.dot(x - origin) - displacement; }
};

/// `arm` is the surface point less the centre: heights far from the origin keep their digits.
void add_point(Contact& contact, const WorldPlane& plane, const Vec3& centre, double centre_height,
               const Vec3& arm) {
  const double height = centre_height + plane.normal.dot(arm);
  contact.add_point(centre + (arm - (height / 2) * plane.normal), -height);
}

}  // namespace

// The deepest point is on the lower cap's rim. A cap stands, and a generator lies, when the rise
// over its whole length is lost in rounding or within what the threshold leaves above the deepest
// point.
Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold) {
  const WorldPlane plane(b, pose_b);
  const Eigen::Matrix3d rotation = pose_a.rotation();
  const Vec3 axis = rotation.col(2);
  // In the body frame, where the part across the axis keeps its digits however small it is.
  const Vec3 local = rotation.transpose() * plane.normal;
  const double cosine = local.z();
  const double sine = std::hypot(local.x(), local.y());
  const Vec3 down = rotation * (sine > 0 ? Vec3(-local.x() / sine, -local.y() / sine, 0)
                                         : Vec3(Vec3::UnitX()));  // within the caps
  const Vec3 lower_axis = cosine > 0 ? Vec3(-axis) : axis;

  Contact result;
  result.normal = plane.normal;
  const double centre_height = plane.height(pose_a.position());
  result.signed_distance = centre_height - a.half_length() * std::abs(cosine) - a.radius() * sine;
  if (result.signed_distance > contact_threshold) return result;

  const Vec3 cap = a.half_length() * lower_axis;
  const Vec3 deepest = cap + a.radius() * down;
  const auto add = [&](const Vec3& arm) {
    add_point(result, plane, pose_a.position(), centre_height, arm);
  };
  add(deepest);

  const double rounding = 16 * std::numeric_limits<double>::epsilon() *
                          (largest_half_extent(a) + std::abs(centre_height));
  const double slack =
      std::max(contact_threshold - std::max(result.signed_distance, 0.0), rounding);
  if (2 * a.radius() * sine <= slack) {
    const Vec3 side = lower_axis.cross(down);
    const double half = 0.5, height = std::numbers::sqrt3 / 2;  // cos 60°, sin 60°
    add(cap + a.radius() * (-half * down + height * side));
    add(cap + a.radius() * (-half * down - height * side));
  } else if (2 * a.half_length() * std::abs(cosine) <= slack) {
    add(deepest - 2 * a.half_length() * lower_axis);
  }
  return result;
}

}  // namespace touchstone
