// A can stands on a crate, a millimetre deep: where do they touch?
#include <cstdio>
#include <touchstone/touchstone.hpp>

using namespace touchstone;

int main() {
  const Cylinder can(0.03, 0.06);        // radius, half length, metres, along local z
  const Box crate(Vec3(0.5, 0.4, 0.3));  // half extents
  const Pose can_pose(Vec3(0.1, 0, 0.359), Eigen::Quaterniond::Identity());

  const Contact c = contact(can, can_pose, crate, Pose(), 1e-6);
  for (const ContactPoint& p : c.points()) {
    std::printf("depth %.3g at %.3f %.3f %.4f\n", p.depth, p.position.x(), p.position.y(),
                p.position.z());
  }
}
