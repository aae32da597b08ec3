// Bullet 3.24's own world, compiled twice: in double precision and in single.
//
// World     btDiscreteDynamicsWorld with btSequentialImpulseConstraintSolver and btDbvtBroadphase;
//           stepSimulation(step, 0), so that a step is ours. Solver settings are Bullet's defaults
//           (10 iterations, split impulse, warm starting) but for sleeping, which is off, as
//           PyBullet has it: a body that sleeps shows no drift. At its best: 200 iterations, and
//           friction along two directions instead of the slip's alone.
// Shapes    btCylinderShapeZ, btBoxShape, btCapsuleShapeZ, btSphereShape with Bullet's default
//           margins; btStaticPlaneShape.
//           A hull is a btConvexHullShape with margin 0: its margin, 0.04 whatever its size, would
//           be added outside it; that of a cylinder lies inside it and rounds its edges. Spheres
//           are children of a btCompoundShape.
// Masses    Inertia of the exact bodies. Bullet multiplies the friction and the restitution of two
//           bodies, so that each gets the square root of ours: together they have the geometric
//           mean.
// Drives    Kinematic objects, which Bullet gives the velocity that leads to their next pose; it
//           finds their contacts there, one step ahead.
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

using Made = std::unique_ptr<btCollisionShape>;

struct MakeShape {
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
      : EngineWorld(scene, setup), dispatcher_(&configuration_) {
    if (is_cured()) bullet::install(dispatcher_);
    if (is_multipoint()) {
      configuration_.setConvexConvexMultipointIterations(3, 3);
      configuration_.setPlaneConvexMultipointIterations(3, 3);
    }
    if (setup.best_solver) {
      world_.getSolverInfo().m_numIterations = 200;
      world_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    }
    world_.setGravity(to_vector(scene.gravity));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) add(i);
  }
  ~BulletWorld() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  Contacts contacts() const override {
    Contacts found;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      found.points += dispatcher_.getManifoldByIndexInternal(i)->getNumContacts();
    }
    return found;
  }

 protected:
  void advance() override {
    world_.stepSimulation(to_scalar(scene_.step), 0);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!scene_.bodies[i].is_free()) continue;
      const btRigidBody& body = *bodies_[i];
      const btQuaternion q = body.getWorldTransform().getRotation();
      set_state(i, from_vector(body.getWorldTransform().getOrigin()), {q.w(), q.x(), q.y(), q.z()},
                from_vector(body.getLinearVelocity()), from_vector(body.getAngularVelocity()));
    }
  }
  void drive(std::size_t body, const BodyState&, const Pose& after) override {
    bodies_[body]->setWorldTransform(to_transform(after));
  }
  void push(std::size_t body, const Push& push) override {
    bodies_[body]->applyCentralForce(to_vector(push.force));
    bodies_[body]->applyTorque(to_vector(push.torque));
  }

 private:
  static btTransform to_transform(const Pose& pose) {
    const Eigen::Quaterniond q = pose.unit_orientation();
    return btTransform(
        btQuaternion(to_scalar(q.x()), to_scalar(q.y()), to_scalar(q.z()), to_scalar(q.w())),
        to_vector(pose.position()));
  }

  static Made make_part(const RoundedPolytope& part) {
    const auto& corners = part.vertices();
    if (corners.size() == 1) return MakeShape{}(Sphere(part.radius()));
    if (corners.size() == 2) {
      return MakeShape{}(Capsule(part.radius(), (corners[1] - corners[0]).norm() / 2));
    }
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& corner : corners) hull->addPoint(to_vector(corner), false);
    hull->setMargin(0);
    hull->recalcLocalAabb();
    return hull;
  }

  btCollisionShape* make_shape(std::size_t body) {
    const auto parts = this->parts(body);
    if (parts.empty()) {
      shapes_.push_back(std::visit(MakeShape{}, shape(body)));
      if (is_no_margin(body)) shapes_.back()->setMargin(0);
    } else if (parts.size() == 1) {
      shapes_.push_back(make_part(parts[0]));
    } else {
      auto compound = std::make_unique<btCompoundShape>();
      for (const RoundedPolytope& part : parts) {
        shapes_.push_back(make_part(part));
        const btTransform place(btQuaternion::getIdentity(), to_vector(part.vertices()[0]));
        compound->addChildShape(place, shapes_.back().get());
      }
      shapes_.push_back(std::move(compound));
    }
    return shapes_.back().get();
  }

  void add(std::size_t index) {
    const Body& body = scene_.bodies[index];
    const Inertia i = body.is_free() ? inertia(body.shape, body.density) : Inertia{0, Vec3::Zero()};
    btRigidBody::btRigidBodyConstructionInfo info(to_scalar(i.mass), nullptr, make_shape(index),
                                                  to_vector(i.principal));
    info.m_startWorldTransform = to_transform(body.pose);
    info.m_friction = to_scalar(std::sqrt(body.material.friction));
    info.m_restitution = to_scalar(std::sqrt(body.material.restitution));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    if (body.drive) {
      bodies_.back()->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    }
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
