#include "contact_of.hpp"

#include "cylinder_box.hpp"
#include "cylinder_capsule.hpp"
#include "cylinder_cylinder.hpp"
#include "cylinder_plane.hpp"
#include "cylinder_sphere.hpp"

namespace touchstone {

Contact contact(const Configuration& c, double contact_threshold) {
  return std::visit(
      [&](const auto& b) { return contact(c.a, c.pose_a, b, c.pose_b, contact_threshold); }, c.b);
}

}  // namespace touchstone
