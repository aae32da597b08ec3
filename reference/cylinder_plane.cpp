#include "cylinder_plane.hpp"

#include <cmath>

#include "manifold.hpp"
#include "scaled.hpp"

namespace touchstone {
namespace {

/// The plane in the world, and how the cylinder stands to it.
struct Stance {
  Vec3 normal;           ///< the plane's, unit
  double centre_height;  ///< of the cylinder's centre above the plane
  Vec3 axis;             ///< the cylinder's
  double cosine;         ///< axis·normal
  Vec3 across;           ///< the normal less its part along the axis
  double sine;           ///< length of `across`; not from the cosine, which hides a small tilt
  double signed_distance;

  Stance(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b) {
    const double squared = b.normal().squaredNorm();
    // Most callers give a unit normal.
    const double length = squared == 1 ? 1 : std::sqrt(squared);
    normal = pose_b.rotation() * b.normal();
    if (length != 1) normal /= length;
    centre_height = normal.dot(pose_a.position() - pose_b.position()) - b.displacement() / length;
    axis = pose_a.axis();
    cosine = axis.dot(normal);
    across = normal - cosine * axis;
    sine = across.norm();
    // The deepest point is on the lower cap's rim.
    signed_distance = centre_height - a.half_length() * std::abs(cosine) - a.radius() * sine;
  }
};

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                               const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return signed_distance(bodies...); }));
  }
  const Stance stance(a, pose_a, b, pose_b);
  return {stance.signed_distance, stance.normal};
}

bool overlaps(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.ask([](const auto&... bodies) { return overlaps(bodies...); });
  }
  return Stance(a, pose_a, b, pose_b).signed_distance <= 0;
}

Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold, const Vec3*) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(scaled.ask([&](const auto&... bodies) {
      return contact(bodies..., scaled.scaled(contact_threshold));
    }));
  }
  const Stance stance(a, pose_a, b, pose_b);
  Contact result;
  result.normal = stance.normal;
  result.signed_distance = stance.signed_distance;
  if (stance.signed_distance > contact_threshold) return result;

  const double size = largest_half_extent(a);
  const ManifoldRule rule(size, size, std::abs(stance.centre_height), stance.signed_distance,
                          contact_threshold);
  const Vec3& origin = pose_a.position();
  if (!lies_flat(a.radius(), stance.sine, rule.slack) &&
      !lies_flat(a.half_length(), stance.cosine, rule.slack)) {
    const Vec3 deepest = -std::copysign(a.half_length(), stance.cosine) * stance.axis -
                         (a.radius() / stance.sine) * stance.across -
                         (stance.signed_distance / 2) * stance.normal;
    result.add_point(origin + deepest, -stance.signed_distance);
    return result;
  }
  const FacingFeature lower = facing(posed(a, pose_a, origin), -stance.normal, rule.slack);
  FacingFeature ground{.kind = FacingFeature::Kind::half_space,
                       .middle = -stance.centre_height * stance.normal,
                       .axis = stance.normal};
  ground.side[0] = pose_b.rotation().col(0);
  add_manifold(result, lower, ground, origin, rule);
  return result;
}

}  // namespace touchstone
