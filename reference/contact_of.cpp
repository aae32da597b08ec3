#include "contact_of.hpp"

#include "cylinder_box.hpp"
#include "cylinder_capsule.hpp"
#include "cylinder_cylinder.hpp"
#include "cylinder_plane.hpp"
#include "cylinder_sphere.hpp"

namespace touchstone {

SignedDistance signed_distance(const Configuration& c) {
  return std::visit([&](const auto& b) { return signed_distance(c.a, c.pose_a, b, c.pose_b); },
                    c.b);
}

CertifiedDistance certified_distance(const Configuration& c) {
  return std::visit([&](const auto& b) { return certified_distance(c.a, c.pose_a, b, c.pose_b); },
                    c.b);
}

bool overlaps(const Configuration& c) {
  return std::visit([&](const auto& b) { return overlaps(c.a, c.pose_a, b, c.pose_b); }, c.b);
}

Contact contact(const Configuration& c, double contact_threshold, const Vec3* previous_normal) {
  return std::visit(
      [&](const auto& b) {
        return contact(c.a, c.pose_a, b, c.pose_b, contact_threshold, previous_normal);
      },
      c.b);
}

}  // namespace touchstone
