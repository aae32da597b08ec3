// A pillar is 0.1 mm deep in another's side. ODE should push it out by a fifth of that in a step of
// 0.01 s, 2 mm/s, however both are turned: it misses it or kicks it away; with one line it does.
#include <cstdio>
#include <ode/ode.h>
#include <touchstone/engines/ode.hpp>

double speed(double angle) {
  const dWorldID world = dWorldCreate();
  const dJointGroupID joints = dJointGroupCreate(0);
  const dBodyID body = dBodyCreate(world);
  const dGeomID pillar = dCreateCylinder(nullptr, 0.1, 0.4),
                lying = dCreateCylinder(nullptr, 0.1, 1);
  dMatrix3 turn, across;
  dRFromEulerAngles(turn, angle, 2 * angle, 0);
  dRFromZAxis(across, turn[0], turn[4], turn[8]);  // the axis of the one that lies is x, turned
  dGeomSetRotation(lying, across);
  dGeomSetBody(pillar, body);
  dBodySetRotation(body, turn);
  dBodySetPosition(body, 0.2999 * turn[2], 0.2999 * turn[6], 0.2999 * turn[10]);
  dContact contacts[8] = {};
  const int count = dCollide(pillar, lying, 8, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    dJointAttach(dJointCreateContact(world, joints, &contacts[i]), body, nullptr);
  }
  dWorldStep(world, 0.01);
  return 1000 * dCalcVectorLength3(dBodyGetLinearVel(body));
}

void report(const char* name) {
  std::printf("%s:", name);
  for (const double angle : {0.0, 0.3, 0.6, 0.9, 1.1, 1.4}) std::printf(" %.1f", speed(angle));
  std::printf(" mm/s\n");
}

int main() {
  dInitODE2(0);
  report("ODE");
  touchstone::ode::install();  // the line
  report("with Touchstone");
}
