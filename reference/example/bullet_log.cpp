// A log of 15 mm radius lies on a level table. Bullet lets it roll away; with one line it stays.
#include <btBulletDynamicsCommon.h>
#include <cmath>
#include <cstdio>
#include <touchstone/engines/bullet.hpp>

double radii_rolled(bool is_cured) {
  const btScalar radius = btScalar(0.015);
  btBoxShape table_shape(btVector3(100, 1, 100));  // y is up
  btCylinderShapeX log_shape(btVector3(btScalar(0.1), radius, radius));
  btVector3 inertia;
  log_shape.calculateLocalInertia(1, inertia);
  btRigidBody table(0, nullptr, &table_shape), log(1, nullptr, &log_shape, inertia);
  table.getWorldTransform().setOrigin(btVector3(0, -1, 0));
  log.getWorldTransform().setOrigin(btVector3(0, radius, 0));

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  if (is_cured) touchstone::bullet::install(dispatcher);  // the line
  world.addRigidBody(&table);
  world.addRigidBody(&log);
  for (int step = 0; step < 600; ++step) world.stepSimulation(btScalar(1) / 60, 0);
  return std::abs(log.getWorldTransform().getOrigin().z()) / radius;
}

int main() {
  std::printf("Bullet: rolled %.1f radii in 10 s\n", radii_rolled(false));
  std::printf("with Touchstone: rolled %.1f radii in 10 s\n", radii_rolled(true));
}
