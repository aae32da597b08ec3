#include "cylinder_cylinder.hpp"

#include "deepest_point.hpp"
#include "reduced_pair.hpp"

namespace touchstone {

Contact contact(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b,
                double contact_threshold) {
  const ReducedPair pair = reduce(a, pose_a, b, pose_b);
  return with_deepest_point(pair, pose_b.position(), largest_gap(pair), contact_threshold);
}

}  // namespace touchstone
