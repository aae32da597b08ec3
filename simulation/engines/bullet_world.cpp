// Bullet 3.24's own world, compiled twice: in double precision and in single.
//
// World     btDiscreteDynamicsWorld with btSequentialImpulseConstraintSolver and btDbvtBroadphase;
//           stepSimulation(step, 0), so that a step is ours. Solver settings are Bullet's defaults
//           (10 iterations, split impulse, warm starting) but for sleeping, which is off, as
//           PyBullet has it: a body that sleeps shows no drift. At its best: 200 iterations,
//           friction along two directions instead of the slip's alone, and continuous motion of
//           what moves by more than its half width in a step: a sphere inside it is cast.
// Shapes    btCylinderShapeZ, btBoxShape, btCapsuleShapeZ, btSphereShape with Bullet's default
//           margins; btStaticPlaneShape; a floor of triangles is a btBvhTriangleMeshShape.
//           A hull, and a convex body, is a btConvexHullShape with margin 0: its margin, 0.04
//           whatever its size, would be added outside it; that of a cylinder lies inside it and
//           rounds its edges. Spheres,
//           and bodies that fixed joints connect, are children of a btCompoundShape.
// Masses    Inertia of the exact bodies. Bullet multiplies the friction and the restitution of two
//           bodies, so that each gets the square root of ours: together they have the geometric
//           mean. What consists of several bodies has that of the parts that touch, by
//           gContactAddedCallback.
// Joints    btGeneric6DofSpring2Constraint with all but one direction locked, as Bullet's importer
//           of URDF makes them. Bullet knows the angle of a hinge within a turn, to which its
//           limits are shifted in each step.
// Belts     What Bullet calls the conveyor belt effect: gContactAddedCallback sets a contact's
//           friction direction and the velocity along it, for which the solver keeps directions
//           and gets two of them in the whole world.
// Drives    Kinematic objects, which Bullet gives the velocity that leads to their next pose; it
//           finds their contacts there, one step ahead.
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>
#include <algorithm>
#include <btBulletDynamicsCommon.h>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "candidates/bullet_mesh.hpp"
#include "reference/engines/bullet.hpp"
#include "simulation/engines/engine_world.hpp"

namespace touchstone {
namespace {

// Numbers and shapes as Bullet's, in the precision in which it is compiled.

btScalar to_scalar(double value) { return static_cast<btScalar>(value); }
btVector3 to_vector(const Vec3& v) {
  return {to_scalar(v.x()), to_scalar(v.y()), to_scalar(v.z())};
}
Vec3 from_vector(const btVector3& v) { return Vec3(v.x(), v.y(), v.z()); }

btTransform to_transform(const Pose& pose) {
  const Eigen::Quaterniond q = pose.unit_orientation();
  return btTransform(
      btQuaternion(to_scalar(q.x()), to_scalar(q.y()), to_scalar(q.z()), to_scalar(q.w())),
      to_vector(pose.position()));
}

/// Shapes as Bullet makes them, with its default margins.
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
  Made operator()(const Convex&) const { return nullptr; }  // a piece with corners
};

/// Margin 0: Bullet's default is added outside a hull.
Made make_hull(const std::vector<Vec3>& corners) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& corner : corners) hull->addPoint(to_vector(corner), false);
  hull->setMargin(0);
  hull->recalcLocalAabb();
  return hull;
}

Made make_piece(const Piece& piece) {
  if (piece.squares > 0) return std::make_unique<BulletFloor>(piece.floor());
  return piece.corners.empty() ? std::visit(MakeShape{}, piece.shape) : make_hull(piece.corners);
}

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
    broadphase_.getOverlappingPairCache()->setOverlapFilterCallback(&filter_);
    gCompoundChildShapePairCallback = gCompoundCompoundChildShapePairCallback = may_meet;
    gContactAddedCallback = describe;
    for (std::size_t i = 0; i < assemblies_.size(); ++i) add(i);
    for (const Joint& joint : scene.joints) {
      joints_.push_back(joint.kind == JointKind::fixed ? nullptr : make(joint));
    }
  }
  ~BulletWorld() override {
    for (const auto& joint : joints_) {
      if (joint) world_.removeConstraint(joint.get());
    }
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
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (scene_.joints[i].kind != JointKind::hinge) continue;
      positions_[i] += scene_.step * angular_rate(*joints_[i]);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!assemblies_[i].is_free()) continue;
      const btRigidBody& body = *bodies_[i];
      const btQuaternion q = body.getWorldTransform().getRotation();
      set_state(i, from_vector(body.getWorldTransform().getOrigin()), {q.w(), q.x(), q.y(), q.z()},
                from_vector(body.getLinearVelocity()), from_vector(body.getAngularVelocity()));
    }
  }
  void drive(std::size_t assembly, const BodyState&, const Pose& after) override {
    bodies_[assembly]->setWorldTransform(to_transform(after));
  }
  void push(std::size_t assembly, const Vec3& force, const Vec3& torque) override {
    bodies_[assembly]->applyCentralForce(to_vector(force));
    bodies_[assembly]->applyTorque(to_vector(torque));
  }
  void prepare_joint(std::size_t index, double time) override {
    const Joint& joint = scene_.joints[index];
    Constraint& made = *joints_[index];
    double& position = positions_[index];
    made.calculateTransforms();
    if (joint.kind == JointKind::hinge) {
      const double angle = made.getAngle(0);
      position = nearest_turn(angle, position);
      set_hinge_limits(made, joint, angle, position - angle);
    } else {
      position = -made.getRelativePivotPosition(0);
    }
    if (!joint.motor) return;
    made.setTargetVelocity(free_axis(joint),
                           to_scalar(motor_rate(joint, position, time, scene_.step)));
  }

 private:
  using Constraint = btGeneric6DofSpring2Constraint;
  using Wrapper = btCollisionObjectWrapper;

  /// Asks for pairs of objects whether any of their bodies may touch.
  struct Filter : btOverlapFilterCallback {
    explicit Filter(const BulletWorld& of) : world(of) {}
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
      const auto bodies = [&](const btBroadphaseProxy* proxy) -> const std::vector<int>& {
        const auto* object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
        return world.assemblies_[object->getUserIndex()].bodies;
      };
      for (const int i : bodies(a)) {
        for (const int j : bodies(b)) {
          if (world.may_touch_(i, j)) return true;
        }
      }
      return false;
    }
    const BulletWorld& world;
  };

  // Bullet's callbacks have no argument of their own: a shape knows its world and body.

  static const BulletWorld& world_of(const btCollisionShape* shape) {
    return *static_cast<const BulletWorld*>(shape->getUserPointer());
  }
  /// For the children of compounds.
  static bool may_meet(const btCollisionShape* a, const btCollisionShape* b) {
    return world_of(a).may_touch_(a->getUserIndex(), b->getUserIndex());
  }
  /// Sets a contact's materials and belt, where one of the objects asks for it.
  static bool describe(btManifoldPoint& point, const Wrapper* a, int, int, const Wrapper* b, int,
                       int) {
    const BulletWorld& world = world_of(a->getCollisionShape());
    const int i = a->getCollisionShape()->getUserIndex(),
              j = b->getCollisionShape()->getUserIndex();
    const Material &first = world.scene_.bodies[i].material,
                   &second = world.scene_.bodies[j].material;
    point.m_combinedFriction = to_scalar(std::sqrt(first.friction * second.friction));
    point.m_combinedRestitution = to_scalar(std::sqrt(first.restitution * second.restitution));
    const Vec3 belt = world.belt(i, j, from_vector(point.m_normalWorldOnB));
    if (const double speed = belt.norm(); speed > 0) {
      point.m_contactPointFlags |= BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
      point.m_lateralFrictionDir1 = to_vector(belt / speed);
      point.m_lateralFrictionDir2 = point.m_lateralFrictionDir1.cross(point.m_normalWorldOnB);
      point.m_contactMotion1 = to_scalar(-speed);  // of the first body along the second
    }
    return true;
  }

  btCollisionShape* make_shape(const Assembly& assembly) {
    auto compound = std::make_unique<btCompoundShape>();
    for (std::size_t i = 0; i < assembly.bodies.size(); ++i) {
      const int body = assembly.bodies[i];
      for (const Piece& piece : pieces(body)) {
        shapes_.push_back(make_piece(piece));
        btCollisionShape* const made = shapes_.back().get();
        if (is_no_margin(body)) made->setMargin(0);
        made->setUserIndex(body);
        made->setUserPointer(this);
        compound->addChildShape(to_transform(shifted(assembly.X_FB[i], piece.centre)), made);
      }
    }
    const bool is_centred = compound->getChildTransform(0) == btTransform::getIdentity();
    if (compound->getNumChildShapes() > 1 || !is_centred) {
      shapes_.push_back(std::move(compound));
    }
    return shapes_.back().get();
  }

  void add(std::size_t index) {
    const Assembly& assembly = assemblies_[index];
    const Material& material = scene_.bodies[assembly.bodies.front()].material;
    const BodyState start = start_of(index);
    btRigidBody::btRigidBodyConstructionInfo info(to_scalar(assembly.inertia.mass), nullptr,
                                                  make_shape(assembly),
                                                  to_vector(assembly.inertia.principal));
    info.m_startWorldTransform = to_transform(start.pose);
    info.m_friction = to_scalar(std::sqrt(material.friction));
    info.m_restitution = to_scalar(std::sqrt(material.restitution));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& made = *bodies_.back();
    made.setUserIndex(static_cast<int>(index));
    if (assembly.driven >= 0) made.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    const bool has_belt = std::any_of(assembly.bodies.begin(), assembly.bodies.end(), [&](int b) {
      return !scene_.bodies[b].surface_velocity.isZero(0);
    });
    if (has_belt || assembly.bodies.size() > 1) {
      made.setCollisionFlags(made.getCollisionFlags() |
                             btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    }
    if (has_belt) {
      world_.getSolverInfo().m_solverMode |=
          SOLVER_ENABLE_FRICTION_DIRECTION_CACHING | SOLVER_USE_2_FRICTION_DIRECTIONS;
    }
    made.setLinearVelocity(to_vector(start.velocity));
    made.setAngularVelocity(to_vector(start.angular_velocity));
    made.setActivationState(DISABLE_DEACTIVATION);
    if (setup_.best_solver) set_continuous(made);
    world_.addRigidBody(&made);
  }

  /// As in Bullet's CcdPhysicsDemo. Bullet leaves compounds out.
  static void set_continuous(btRigidBody& body) {
    btVector3 low, high;
    body.getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
    const btVector3 half = (high - low) / 2;
    const btScalar half_width = half[half.minAxis()];
    body.setCcdMotionThreshold(half_width);
    body.setCcdSweptSphereRadius(to_scalar(0.9) * half_width);
  }

  /// Index of the direction that a joint leaves free: along or about x.
  static int free_axis(const Joint& joint) { return joint.kind == JointKind::hinge ? 3 : 0; }

  /// Angular velocity of a hinge's first body relative to the second, about its axis.
  static double angular_rate(const Constraint& made) {
    const btVector3 axis = made.getCalculatedTransformA().getBasis().getColumn(0);
    return axis.dot(made.getRigidBodyA().getAngularVelocity() -
                    made.getRigidBodyB().getAngularVelocity());
  }

  /// Sets the limits of a hinge at an angle within one turn, and at its position that many radians
  /// beyond. Bullet adds a turn to an angle beyond both limits if the other one is then nearer. So
  /// of limits that are far from each other it gets the nearer one, with the other an odd number of
  /// half turns away, beyond reach.
  static void set_hinge_limits(Constraint& made, const Joint& joint, double angle, double turns) {
    constexpr double beyond_reach = 2001 * std::numbers::pi;
    double lower = joint.lower - turns, upper = joint.upper - turns;
    if (std::isinf(lower) && std::isinf(upper)) return;
    if (upper - lower > std::numbers::pi) {
      const bool is_upper_nearer = upper - angle < angle - lower;
      (is_upper_nearer ? lower : upper) =
          is_upper_nearer ? upper - beyond_reach : lower + beyond_reach;
    }
    // Not by setLimit, which takes the turns away.
    btRotationalLimitMotor2& limits = *made.getRotationalLimitMotor(0);
    limits.m_loLimit = to_scalar(lower);
    limits.m_hiLimit = to_scalar(upper);
  }

  std::unique_ptr<Constraint> make(const Joint& joint) {
    btRigidBody& a = *bodies_[assembly_of(joint.a)];
    btRigidBody& b =
        joint.b == world_body ? btTypedConstraint::getFixedBody() : *bodies_[assembly_of(joint.b)];
    const bool turns = joint.kind == JointKind::hinge;
    const Vec3 anchor = turns ? joint.anchor : from_vector(a.getWorldTransform().getOrigin());
    const btTransform frame = to_transform(Pose(anchor, turn_between(Vec3::UnitX(), joint.axis)));
    auto made = std::make_unique<Constraint>(a, b, a.getWorldTransform().inverse() * frame,
                                             b.getWorldTransform().inverse() * frame);
    for (int axis = 0; axis < 6; ++axis) made->setLimit(axis, 0, 0);
    made->setLimit(free_axis(joint), 1, -1);  // none
    // Angles are of the first body relative to the second, positions of the second to the first.
    if (!turns && (std::isfinite(joint.lower) || std::isfinite(joint.upper))) {
      made->setLimit(0, to_scalar(std::max(-joint.upper, -max_in_world)),
                     to_scalar(std::min(-joint.lower, max_in_world)));
    }
    if (joint.motor) {
      made->enableMotor(free_axis(joint), true);
      made->setMaxMotorForce(free_axis(joint), to_scalar(joint.motor->max_force));
    }
    world_.addConstraint(made.get());
    return made;
  }

  btDefaultCollisionConfiguration configuration_;
  mutable btCollisionDispatcher dispatcher_;  // its reading functions are not const
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  ///< by assembly
  std::vector<std::unique_ptr<Constraint>> joints_;   ///< by joint; null where it is fixed
  /// By joint, rad or m; of a hinge, after a step, where it should have led.
  std::vector<double> positions_ = std::vector<double>(scene_.joints.size());
  Filter filter_{*this};
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
      "200 iterations, two friction directions, continuous motion", begin};
  return &module;
}
