#include "cylinder_plane.hpp"

#include <cmath>

#include "manifold.hpp"

namespace touchstone {
namespace {

/// The plane in the world: unit normal, and the height of a point above it.
struct WorldPlane {
  Vec3 normal, side;
  double displacement;
  WorldPlane(const Plane& plane, const Pose& pose) {
    const double length = plane.normal().norm();
    normal = pose.rotation() * (plane.normal() / length);
    side = pose.rotation().col(0);
    displacement = plane.displacement() / length;
  }
};

}  // namespace

// The deepest point is on the lower cap's rim.
Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold) {
  const WorldPlane plane(b, pose_b);
  const Vec3 axis = pose_a.axis();
  const double cosine = axis.dot(plane.normal);
  // Not from the cosine, which hides a small tilt.
  const double sine = axis.cross(plane.normal).norm();
  const double centre_height =
      plane.normal.dot(pose_a.position() - pose_b.position()) - plane.displacement;

  Contact result;
  result.normal = plane.normal;
  result.signed_distance = centre_height - a.half_length() * std::abs(cosine) - a.radius() * sine;
  if (result.signed_distance > contact_threshold) return result;

  const double size = largest_half_extent(a);
  const ManifoldRule rule(size, size, std::abs(centre_height), result.signed_distance,
                          contact_threshold);
  const PosedCylinder posed{Vec3::Zero(), axis, a.radius(), a.half_length()};
  FacingFeature ground{.kind = FacingFeature::Kind::half_space,
                       .middle = -centre_height * plane.normal,
                       .axis = plane.normal};
  ground.side[0] = plane.side;
  add_manifold(result, facing(posed, -plane.normal, rule.slack), ground, pose_a.position(), rule);
  return result;
}

}  // namespace touchstone
