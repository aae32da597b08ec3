#include "cylinder_box.hpp"

#include "manifold.hpp"
#include "reduced_pair.hpp"

namespace touchstone {

Contact contact(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b,
                double contact_threshold) {
  const ReducedPair pair = reduce(a, pose_a, b, pose_b);
  const BestNormal best = largest_gap(pair);
  Contact result;
  result.normal = best.normal;
  result.signed_distance = best.gap;
  if (best.gap > contact_threshold) return result;

  const ManifoldRule rule(largest_half_extent(a), largest_half_extent(b), pair.d.norm(), best.gap,
                          contact_threshold);
  const PosedCylinder posed_a{pair.d, pose_a.axis(), a.radius(), a.half_length()};
  const PosedBox posed_b{Vec3::Zero(), pose_b.rotation(), b.half_extents()};
  add_manifold(result, facing(posed_a, -best.normal, rule.slack),
               facing(posed_b, best.normal, rule.slack), pose_b.position(), rule);
  return result;
}

}  // namespace touchstone
