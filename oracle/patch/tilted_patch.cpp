#include "oracle/patch/contact_patch.hpp"
#include "oracle/patch/convex_polygon.hpp"
#include "oracle/patch/patch_plane.hpp"
#include "oracle/patch/support_part.hpp"

namespace touchstone::oracle {

ContactPatch contact_patch(const Configuration& c, const Vec3& n, double epsilon) {
  // Near the bodies, so that their distance from the world's origin costs no digits.
  const Vec3 origin = c.pose_a.position();
  const ContactPatch::Plane plane = patch_plane(c, n, origin, n.unitOrthogonal());
  const auto seen_along_n = [&](const Shape& shape, const Pose& pose, const Vec3& outward) {
    std::vector<Vec2> seen;
    for (const Vec3& p : support_part(shape, pose, outward, epsilon, origin)) {
      seen.emplace_back(p.dot(plane.e1), p.dot(plane.e2));
    }
    return convex_hull(seen);
  };
  const std::vector<Vec2> part_a = seen_along_n(c.a, c.pose_a, -n);
  if (std::holds_alternative<Plane>(c.b)) return {plane, ConvexSet::polygon(part_a)};
  const std::vector<Vec2> part_b = seen_along_n(c.b, c.pose_b, n);
  const std::vector<Vec2> common = intersection(part_a, part_b);
  if (common.empty()) return {plane, ConvexSet::point(halfway(part_a, part_b))};
  return {plane, ConvexSet::polygon(common)};
}

}  // namespace touchstone::oracle
