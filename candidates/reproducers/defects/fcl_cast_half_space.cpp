// FCL 0.7.0: continuousCollide by conservative advancement ends the process where a body is a
// half-space.
//
// Expected  time of contact 0.5. The lower cap of a can of 2 m comes down from z = 1 to the ground,
//           which is half way of the 2 m that the can moves.
// Seen      a segmentation fault.
// Compile   g++ fcl_cast_half_space.cpp -o reproducer -I /usr/include/eigen3 -lfcl -lccd
//           (Debian 12: apt-get install g++ libfcl-dev)
#include <cstdio>
#include <fcl/fcl.h>

int main() {
  const fcl::Cylinderd can(0.5, 2);
  const fcl::Halfspaced ground(fcl::Vector3d(0, 0, 1), 0);
  fcl::Transform3d start = fcl::Transform3d::Identity(), end = start, fixed = start;
  start.translation().z() = 2;
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_TRANS;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  fcl::ContinuousCollisionResultd result;
  std::printf("half-space: ");
  std::fflush(stdout);
  fcl::continuousCollide(&can, start, end, &ground, fixed, fixed, request, result);
  std::printf("touch %d, time of contact %g\n", result.is_collide, result.time_of_contact);
  return result.is_collide && result.time_of_contact > 0.49 && result.time_of_contact < 0.51 ? 0
                                                                                             : 1;
}
