#include <stdexcept>

#include "contact.hpp"

namespace touchstone {

SignedDistance signed_distance(const Cylinder&, const Pose&, const Convex&, const Pose&) {
  throw std::logic_error("convex: later stage");
}
CertifiedDistance certified_distance(const Cylinder&, const Pose&, const Convex&, const Pose&) {
  throw std::logic_error("convex: later stage");
}
bool overlaps(const Cylinder&, const Pose&, const Convex&, const Pose&) {
  throw std::logic_error("convex: later stage");
}
Contact contact(const Cylinder&, const Pose&, const Convex&, const Pose&, double, const Vec3*,
                PointRange) {
  throw std::logic_error("convex: later stage");
}

}  // namespace touchstone
