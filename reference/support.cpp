#include "support.hpp"

#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// Support functions in the body frame: Ericson, "Real-Time Collision Detection", 4.3 and 9.5.
double local_support(const Cylinder& s, const Vec3& n) {
  return s.half_length() * std::abs(n.z()) + s.radius() * std::hypot(n.x(), n.y());
}
double local_support(const Plane& s, const Vec3& n) {
  return n == s.unit_normal() ? s.unit_displacement() : std::numeric_limits<double>::infinity();
}
double local_support(const Sphere& s, const Vec3&) { return s.radius(); }
double local_support(const Capsule& s, const Vec3& n) {
  return s.half_length() * std::abs(n.z()) + s.radius();
}
double local_support(const Box& s, const Vec3& n) { return s.half_extents().dot(n.cwiseAbs()); }

double centred_support(const Shape& shape, const Pose& pose, const Vec3& n) {
  const Vec3 local = pose.rotation().transpose() * n;
  return std::visit([&](const auto& s) { return local_support(s, local); }, shape);
}

}  // namespace

double support(const Shape& shape, const Pose& pose, const Vec3& n) {
  return pose.position().dot(n) + centred_support(shape, pose, n);
}

double gap(const Configuration& c, const Vec3& n) {
  // Positions are subtracted first: far from the origin their dot products would cancel.
  return (c.pose_a.position() - c.pose_b.position()).dot(n) - centred_support(c.a, c.pose_a, -n) -
         centred_support(c.b, c.pose_b, n);
}

}  // namespace touchstone
