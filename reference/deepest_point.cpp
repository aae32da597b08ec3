#include "deepest_point.hpp"

#include "witness.hpp"

namespace touchstone {

Contact with_deepest_point(const Configuration& c, const BestNormal& best,
                           double contact_threshold) {
  Contact contact;
  contact.normal = best.normal;
  contact.signed_distance = best.gap;
  if (best.gap <= contact_threshold) {
    const Witness w = witness(c.a, c.pose_a, c.b, c.pose_b, best.normal, best.gap);
    contact.add_point((w.on_a + w.on_b) / 2, -best.gap);
  }
  return contact;
}

}  // namespace touchstone
