// Bullet 3.24's own world, compiled twice: in double precision and in single.
//
// World     btDiscreteDynamicsWorld with btSequentialImpulseConstraintSolver and btDbvtBroadphase;
//           stepSimulation(step, 0), so that a step is ours. Solver settings are Bullet's defaults
//           (10 iterations, split impulse, warm starting) but for sleeping, which is off, as
//           PyBullet has it: a body that sleeps shows no drift. At its best: 200 iterations, and
//           friction along two directions instead of the slip's alone.
// Shapes    btCylinderShapeZ, btBoxShape, btCapsuleShapeZ, btSphereShape with Bullet's default
//           margins; btStaticPlaneShape.
// Masses    Inertia of the exact bodies. Bullet multiplies the friction of two bodies, so that each
//           gets the square root of ours: together they have the geometric mean.
#include <algorithm>
#include <btBulletDynamicsCommon.h>
#include <cmath>

#include "reference/engines/bullet.hpp"
#include "simulation/engines/engine_world.hpp"

namespace touchstone {
namespace {

btScalar to_scalar(double value) { return static_cast<btScalar>(value); }
btVector3 to_vector(const Vec3& v) {
  return {to_scalar(v.x()), to_scalar(v.y()), to_scalar(v.z())};
}
Vec3 from_vector(const btVector3& v) { return Vec3(v.x(), v.y(), v.z()); }

struct MakeShape {
  using Made = std::unique_ptr<btCollisionShape>;
  Made operator()(const Cylinder& s) const {
    return std::make_unique<btCylinderShapeZ>(
        to_vector(Vec3(s.radius(), s.radius(), s.half_length())));
  }
  Made operator()(const Plane& s) const {
    return std::make_unique<btStaticPlaneShape>(to_vector(s.unit_normal()),
                                                to_scalar(s.unit_displacement()));
  }
  Made operator()(const Sphere& s) const {
    return std::make_unique<btSphereShape>(to_scalar(s.radius()));
  }
  Made operator()(const Capsule& s) const {
    return std::make_unique<btCapsuleShapeZ>(to_scalar(s.radius()), to_scalar(2 * s.half_length()));
  }
  Made operator()(const Box& s) const {
    return std::make_unique<btBoxShape>(to_vector(s.half_extents()));
  }
};

class BulletWorld : public EngineWorld {
 public:
  BulletWorld(const Scene& scene, const EngineSetup& setup)
      : EngineWorld(scene), dispatcher_(&configuration_) {
    if (setup.cured) bullet::install(dispatcher_);
    if (setup.best_solver) {
      world_.getSolverInfo().m_numIterations = 200;
      world_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    }
    world_.setGravity(to_vector(scene.gravity));
    for (const Body& body : scene.bodies) add(body);
  }
  ~BulletWorld() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  void step() override {
    world_.stepSimulation(to_scalar(scene_.step), 0);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (scene_.bodies[i].fixed) continue;
      const btRigidBody& body = *bodies_[i];
      const btQuaternion q = body.getWorldTransform().getRotation();
      set_state(i, from_vector(body.getWorldTransform().getOrigin()), {q.w(), q.x(), q.y(), q.z()},
                from_vector(body.getLinearVelocity()), from_vector(body.getAngularVelocity()));
    }
  }

  Contacts contacts() const override {
    Contacts found;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      found.points += dispatcher_.getManifoldByIndexInternal(i)->getNumContacts();
    }
    return found;
  }

 private:
  void add(const Body& body) {
    shapes_.push_back(std::visit(MakeShape{}, body.shape));
    const Inertia i = body.fixed ? Inertia{0, Vec3::Zero()} : inertia(body.shape, body.density);
    btRigidBody::btRigidBodyConstructionInfo info(to_scalar(i.mass), nullptr, shapes_.back().get(),
                                                  to_vector(i.principal));
    const Eigen::Quaterniond q = body.pose.unit_orientation();
    info.m_startWorldTransform = btTransform(
        btQuaternion(to_scalar(q.x()), to_scalar(q.y()), to_scalar(q.z()), to_scalar(q.w())),
        to_vector(body.pose.position()));
    info.m_friction = to_scalar(std::sqrt(body.material.friction));
    info.m_restitution = to_scalar(body.material.restitution);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setLinearVelocity(to_vector(body.velocity));
    bodies_.back()->setAngularVelocity(to_vector(body.angular_velocity));
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(bodies_.back().get());
  }

  btDefaultCollisionConfiguration configuration_;
  mutable btCollisionDispatcher dispatcher_;  // its reading functions are not const
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

std::unique_ptr<Simulation> begin(const Scene& scene, const EngineSetup& setup) {
  return std::make_unique<BulletWorld>(scene, setup);
}

constexpr bool is_single = sizeof(btScalar) == sizeof(float);

}  // namespace
}  // namespace touchstone

const touchstone::EngineModule* touchstone_engine() {
  using namespace touchstone;
  static const EngineModule module = {
      TOUCHSTONE_BULLET_VERSION,
      is_single ? "single precision; btDiscreteDynamicsWorld, sequential impulses, 10 iterations; "
                  "default margins; sleeping off"
                : "double precision; btDiscreteDynamicsWorld, sequential impulses, 10 iterations; "
                  "default margins; sleeping off",
      "200 iterations, two friction directions", begin};
  return &module;
}
