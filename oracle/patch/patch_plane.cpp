#include "oracle/patch/patch_plane.hpp"

#include <cmath>

namespace touchstone::oracle {
namespace {

// How far a body reaches from its position along the unit vector n of its own frame; a plane to its
// surface whatever n is (Ericson, "Real-Time Collision Detection", 4.3 and 9.5).
double reach(const Cylinder& s, const Vec3& n) {
  return s.half_length() * std::abs(n.z()) + s.radius() * std::hypot(n.x(), n.y());
}
double reach(const Capsule& s, const Vec3& n) {
  return s.half_length() * std::abs(n.z()) + s.radius();
}
double reach(const Sphere& s, const Vec3&) { return s.radius(); }
double reach(const Box& s, const Vec3& n) { return s.half_extents().dot(n.cwiseAbs()); }
double reach(const Plane& s, const Vec3&) { return s.unit_displacement(); }

double reach(const Shape& shape, const Pose& pose, const Vec3& n) {
  const Vec3 local = pose.rotation().transpose() * n;
  return std::visit([&](const auto& s) { return reach(s, local); }, shape);
}

}  // namespace

ContactPatch::Plane patch_plane(const Configuration& c, const Vec3& n, const Vec3& through,
                                const Vec3& e1) {
  const double height_a = (c.pose_a.position() - through).dot(n) - reach(c.a, c.pose_a, -n);
  const double height_b = (c.pose_b.position() - through).dot(n) + reach(c.b, c.pose_b, n);
  const Vec3 unit = e1.normalized();
  const Vec3 across = (unit - unit.dot(n) * n).normalized();
  return {through + (height_a + height_b) / 2 * n, across, n.cross(across)};
}

}  // namespace touchstone::oracle
