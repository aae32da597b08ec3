#include "cylinder_sphere.hpp"

#include <cmath>

namespace touchstone {

// In the cylinder's frame the sphere's centre has a height z and a distance ρ from the axis.
// Outside, the nearest point of the cylinder is found by clamping both; inside, the nearer of cap
// and side. With both z and ρ beyond their bounds it lies on the rim.
Contact contact(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                double contact_threshold) {
  const Eigen::Matrix3d rotation = pose_a.rotation();
  const Vec3 centre = rotation.transpose() * (pose_b.position() - pose_a.position());
  const double rho = std::hypot(centre.x(), centre.y());
  const Vec3 radial = rho > 0 ? Vec3(centre.x() / rho, centre.y() / rho, 0) : Vec3::UnitX();
  const Vec3 axial(0, 0, std::copysign(1, centre.z()));
  const double beyond_cap = std::abs(centre.z()) - a.half_length();
  const double beyond_side = rho - a.radius();

  double distance;  // of the centre from the cylinder's surface, negative inside
  Vec3 outward;     // of the cylinder, its own frame
  if (beyond_cap > 0 && beyond_side > 0) {
    distance = std::hypot(beyond_cap, beyond_side);
    outward = (beyond_cap * axial + beyond_side * radial) / distance;
  } else if (beyond_cap >= beyond_side) {
    distance = beyond_cap;
    outward = axial;
  } else {
    distance = beyond_side;
    outward = radial;
  }

  Contact result;
  result.normal = -(rotation * outward);
  result.signed_distance = distance - b.radius();
  if (result.signed_distance <= contact_threshold) {
    // From the centre towards the cylinder: the sphere's surface, then half of the way between.
    result.add_point(pose_b.position() + (b.radius() + result.signed_distance / 2) * result.normal,
                     -result.signed_distance);
  }
  return result;
}

}  // namespace touchstone
