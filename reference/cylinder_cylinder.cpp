#include "cylinder_cylinder.hpp"

#include "deepest_point.hpp"
#include "reduced_pair.hpp"

namespace touchstone {

Contact contact(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b,
                double contact_threshold) {
  const BestNormal best = largest_gap(reduce(a, pose_a, b, pose_b));
  return with_deepest_point({a, pose_a, b, pose_b}, best, contact_threshold);
}

}  // namespace touchstone
