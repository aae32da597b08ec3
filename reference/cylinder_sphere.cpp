#include "closed_forms.hpp"
#include "pair.hpp"

// The signed distance is a closed form (closed_forms.hpp), and its point the only one.

namespace touchstone {
namespace {

class SphereRoutine {
 public:
  SphereRoutine(const PosedCylinder& a, const PosedSphere& b) : a_(a), b_(b) {}

  [[gnu::always_inline]] SignedDistance find(double stop_above) const {
    return closed_form(a_, b_, stop_above);
  }
  CertifiedDistance find_certified() const { return {find(no_early_exit), 0}; }

  void add_points(Contact& contact, const Vec3& origin, double, PointRange) const {
    // From the centre towards the cylinder: the sphere's surface, then half of the way between.
    const double way = b_.radius + contact.signed_distance / 2;
    contact.add_point(origin + way * contact.normal, -contact.signed_distance);
  }

 private:
  const PosedCylinder& a_;
  const PosedSphere& b_;
};

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                               const Pose& pose_b) {
  return find_signed_distance<SphereRoutine>(a, pose_a, b, pose_b);
}
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                                     const Pose& pose_b) {
  return find_certified_distance<SphereRoutine>(a, pose_a, b, pose_b);
}
bool overlaps(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b) {
  return find_overlap<SphereRoutine>(a, pose_a, b, pose_b);
}
Contact contact(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal, PointRange range) {
  return find_contact<SphereRoutine>(a, pose_a, b, pose_b, contact_threshold, previous_normal,
                                     range);
}

}  // namespace touchstone
