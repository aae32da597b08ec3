// Bullet's own pipeline with the drop-in: the dispatcher's algorithms and persistent manifolds, and
// contactPairTest. Compiled once in double and once in single precision.
#include "reference/engines/bullet.hpp"

#include <btBulletDynamicsCommon.h>
#include <memory>

#include "reference/engines/drop_in_test.hpp"

// CTest knows the tests of both programs by name.
#ifdef BT_USE_DOUBLE_PRECISION
#define DROP_IN BulletDropIn
#else
#define DROP_IN BulletFloatDropIn
#endif

namespace touchstone {
namespace {

constexpr bool is_double = sizeof(btScalar) == sizeof(double);
constexpr double precision = is_double ? 1e-12 : 2e-5;

btVector3 to_bullet(const Vec3& v) {
  return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}

/// Lengths along x, y and z of a shape whose axis is `up`.
btVector3 along(int up, double radius, double half_length) {
  Vec3 v = Vec3::Constant(radius);
  v[up] = half_length;
  return to_bullet(v);
}

std::unique_ptr<btCollisionShape> make_shape(const Shape& shape, int up) {
  if (const auto* s = std::get_if<Cylinder>(&shape)) {
    const btVector3 half = along(up, s->radius(), s->half_length());
    if (up == 0) return std::make_unique<btCylinderShapeX>(half);
    if (up == 1) return std::make_unique<btCylinderShape>(half);
    return std::make_unique<btCylinderShapeZ>(half);
  }
  if (const auto* s = std::get_if<Capsule>(&shape)) {
    const btScalar r = btScalar(s->radius()), length = btScalar(2 * s->half_length());
    if (up == 0) return std::make_unique<btCapsuleShapeX>(r, length);
    if (up == 1) return std::make_unique<btCapsuleShape>(r, length);
    return std::make_unique<btCapsuleShapeZ>(r, length);
  }
  if (const auto* s = std::get_if<Sphere>(&shape)) {
    return std::make_unique<btSphereShape>(btScalar(s->radius()));
  }
  if (const auto* s = std::get_if<Box>(&shape)) {
    return std::make_unique<btBoxShape>(to_bullet(s->half_extents()));
  }
  const auto& plane = std::get<Plane>(shape);
  return std::make_unique<btStaticPlaneShape>(to_bullet(plane.unit_normal()),
                                              btScalar(plane.unit_displacement()));
}

/// Where Bullet has to put a body of that axis to be where ours is, whose axis is z.
btTransform to_transform(const Shape& shape, const Pose& pose, int up) {
  Eigen::Matrix3d r = pose.rotation();
  if (std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Capsule>(shape)) {
    for (int i = 0; i < 3; ++i) r.col((up + 1 + i) % 3) = pose.rotation().col(i);
  }
  const auto row = [&](int i) { return to_bullet(r.row(i)); };
  return btTransform(btMatrix3x3(row(0), row(1), row(2)), to_bullet(pose.position()));
}

/// Two bodies and a world without dynamics.
class Bodies {
 public:
  Bodies(const Shape& first, const Shape& second, bool is_cured = true, int up = 2)
      : first_(make_shape(first, up)), second_(make_shape(second, up)) {
    if (is_cured) bullet::install(dispatcher);
    object_[0].setCollisionShape(first_.get());
    object_[1].setCollisionShape(second_.get());
  }
  ~Bodies() { release(); }
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  btCollisionObject& object(int i) { return object_[i]; }
  btCollisionShape& shape(int i) { return i == 0 ? *first_ : *second_; }

  /// Collides as a world's step does, with the manifold of the last time.
  void step() {
    const Wrap a(object_[0]), b(object_[1]);
    if (!algorithm_) {
      algorithm_ =
          dispatcher.findAlgorithm(&a.wrapper, &b.wrapper, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    }
    btManifoldResult result(&a.wrapper, &b.wrapper);
    algorithm_->processCollision(&a.wrapper, &b.wrapper, info_, &result);
  }
  btPersistentManifold& manifold() { return *dispatcher.getManifoldByIndexInternal(0); }
  /// Their points, with the normal from the second body to the first.
  std::vector<EnginePoint> points() {
    std::vector<EnginePoint> found;
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold& all = *dispatcher.getManifoldByIndexInternal(m);
      const double sign = all.getBody0() == &object_[0] ? 1 : -1;
      for (int i = 0; i < all.getNumContacts(); ++i) {
        const btManifoldPoint& p = all.getContactPoint(i);
        const auto vec3 = [](const btVector3& v) { return Vec3(v.x(), v.y(), v.z()); };
        found.push_back({(vec3(p.getPositionWorldOnA()) + vec3(p.getPositionWorldOnB())) / 2,
                         sign * vec3(p.m_normalWorldOnB), -double{p.getDistance()}});
      }
    }
    return found;
  }
  void release() {
    if (!algorithm_) return;
    algorithm_->~btCollisionAlgorithm();
    dispatcher.freeCollisionAlgorithm(algorithm_);
    algorithm_ = nullptr;
  }

 private:
  struct Wrap {
    explicit Wrap(const btCollisionObject& o)
        : wrapper(nullptr, o.getCollisionShape(), &o, o.getWorldTransform(), -1, -1) {}
    btCollisionObjectWrapper wrapper;
  };
  btDefaultCollisionConfiguration configuration_;

 public:
  btCollisionDispatcher dispatcher{&configuration_};

 private:
  btDispatcherInfo info_;
  std::unique_ptr<btCollisionShape> first_, second_;
  btCollisionObject object_[2];
  btCollisionAlgorithm* algorithm_ = nullptr;
};

/// btPersistentManifold::getCacheEntry takes a point for one that is nearer to it, on the
/// manifold's first body, than the threshold. That is what the drop-in makes of it: how far apart
/// the bodies are at the point, but from a thousandth of the breaking threshold to the whole.
/// `side`: of that body along the normal from B to A.
template <int side>
bool is_same(const Contact& c, const ContactPoint& p, const ContactPoint& kept, double breaking) {
  const auto on_first = [&](const ContactPoint& q) {
    return Vec3(q.position + side * q.depth / 2 * c.normal);
  };
  return (on_first(p) - on_first(kept)).norm() < std::clamp(-p.depth, breaking / 1000, breaking);
}

/// As Bullet holds it: in single precision the lengths and poses are rounded.
void expect_all_poses(Pair pair, int up, bool cylinder_is_first) {
  for (const Identity& id : everyday_poses(pair, 5)) {
    const Configuration c = make_configuration(id);
    SCOPED_TRACE(to_string(id));
    Bodies bodies(cylinder_is_first ? Shape(c.a) : c.b, cylinder_is_first ? c.b : Shape(c.a), true,
                  up);
    bodies.object(cylinder_is_first ? 0 : 1).setWorldTransform(to_transform(c.a, c.pose_a, up));
    bodies.object(cylinder_is_first ? 1 : 0).setWorldTransform(to_transform(c.b, c.pose_b, up));
    bodies.step();
    const auto points = bodies.points();
    expect_as_ours(c, bodies.manifold().getContactBreakingThreshold(), 4,
                   cylinder_is_first ? points : turned_round(points), precision,
                   cylinder_is_first ? is_same<-1> : is_same<1>);
  }
}

TEST(DROP_IN, AnswersEveryPairInBothOrdersAndAllUpAxes) {
  for (const Pair pair : pairs_of_sizes) {
    for (const int up : {0, 1, 2}) {
      SCOPED_TRACE(up);
      expect_all_poses(pair, up, true);
      expect_all_poses(pair, up, false);
    }
  }
}

const Cylinder can(0.5, 1);
const Box crate(Vec3(2, 2, 1));
/// Not turned.
btTransform at(double x, double y, double z) {
  return btTransform(btQuaternion::getIdentity(), btVector3(btScalar(x), btScalar(y), btScalar(z)));
}
const btTransform standing = at(0, 0, 1.99);

TEST(DROP_IN, MarginsChangeNothing) {
  for (const double margin : {0.0, 0.01, 0.2}) {
    Bodies bodies(can, crate);
    bodies.shape(0).setMargin(btScalar(margin));
    bodies.shape(1).setMargin(btScalar(margin));
    bodies.object(0).setWorldTransform(standing);
    bodies.step();
    ASSERT_EQ(bodies.points().size(), 3u);
    for (const EnginePoint& p : bodies.points()) EXPECT_NEAR(p.depth, 0.01, 10 * precision);
  }
}

TEST(DROP_IN, LocalScalingCounts) {
  Bodies bodies(can, crate);
  bodies.shape(0).setLocalScaling(btVector3(2, 2, 2));
  bodies.object(0).setWorldTransform(at(0, 0, 2.99));
  bodies.step();
  ASSERT_EQ(bodies.points().size(), 3u);
  EXPECT_NEAR(bodies.points()[0].depth, 0.01, 10 * precision);
  EXPECT_NEAR(bodies.points()[0].position.head<2>().norm(), 1, 10 * precision);
}

TEST(DROP_IN, ReportsSeparateBodiesUpToTheBreakingThreshold) {
  Bodies bodies(can, crate);
  bodies.object(0).setWorldTransform(standing);
  bodies.step();
  const double breaking = bodies.manifold().getContactBreakingThreshold();
  for (const auto& [gap, count] : {std::pair(0.9 * breaking, 3u), std::pair(1.1 * breaking, 0u)}) {
    bodies.object(0).setWorldTransform(at(0, 0, 2 + gap));
    bodies.step();
    ASSERT_EQ(bodies.points().size(), count);
    for (const EnginePoint& p : bodies.points()) EXPECT_NEAR(p.depth, -gap, 10 * precision);
  }
}

TEST(DROP_IN, AnswersChildrenOfCompounds) {
  btCylinderShapeX wheel(btVector3(btScalar(0.1), btScalar(0.5), btScalar(0.5)));
  btCompoundShape axle;
  for (const double x : {-1.0, 1.0}) {
    axle.addChildShape(at(x, 0, 0), &wheel);
  }
  Bodies bodies(can, crate);
  bodies.object(0).setCollisionShape(&axle);
  bodies.object(0).setWorldTransform(at(0, 0, 1.49));
  bodies.step();
  const auto points = bodies.points();
  ASSERT_EQ(points.size(), 4u);
  for (const EnginePoint& p : points) {
    EXPECT_NEAR(p.depth, 0.01, 10 * precision);
    EXPECT_NEAR(std::abs(std::abs(p.position.x()) - 1), 0.1, 10 * precision);
    EXPECT_NEAR(p.normal.z(), 1, precision);
  }
  bodies.release();
}

TEST(DROP_IN, PointsKeepTheirImpulsesWhileABodyRests) {
  Bodies bodies(can, crate);
  bodies.object(0).setWorldTransform(standing);
  bodies.step();
  for (int i = 0; i < 3; ++i)
    bodies.manifold().getContactPoint(i).m_appliedImpulse = btScalar(i + 1);
  std::vector<Vec3> before;
  for (const EnginePoint& p : bodies.points()) before.push_back(p.position);
  for (int k = 1; k <= 10; ++k) {  // leans by what an integrator leaves, and sinks
    const btScalar tilt = btScalar((is_double ? 1e-9 : 1e-8) * (k % 3 - 1));
    bodies.object(0).setWorldTransform(btTransform(btQuaternion(btVector3(1, 0, 0), tilt),
                                                   btVector3(0, 0, btScalar(1.99 - 1e-5 * k))));
    bodies.step();
    ASSERT_EQ(bodies.manifold().getNumContacts(), 3);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(bodies.manifold().getContactPoint(i).m_appliedImpulse, i + 1);
      EXPECT_EQ(bodies.manifold().getContactPoint(i).getLifeTime(), k + 1);
      EXPECT_NEAR((bodies.points()[i].position - before[i]).norm(), 0, 1e-3);
    }
  }
}

int contacts_ended = 0;

TEST(DROP_IN, ALogThatRollsHasItsTwoPointsBelowItAndTheirImpulses) {
  Bodies bodies(can, Plane(Vec3::UnitZ(), 0));
  contacts_ended = 0;
  gContactEndedCallback = [](btPersistentManifold* const&) { ++contacts_ended; };
  for (int k = 0; k < 50; ++k) {
    const btScalar angle = btScalar(0.1 * k);
    const btQuaternion lying(btVector3(0, 1, 0), btScalar(M_PI / 2));
    bodies.object(0).setWorldTransform(
        btTransform(btQuaternion(btVector3(1, 0, 0), -angle) * lying,
                    btVector3(0, btScalar(0.5) * angle, btScalar(0.499))));
    bodies.step();
    ASSERT_EQ(bodies.manifold().getNumContacts(), 2) << k;
    for (int i = 0; i < 2; ++i) {
      const EnginePoint p = bodies.points()[i];
      EXPECT_NEAR(p.position.y(), 0.05 * k, 100 * precision);
      EXPECT_NEAR(std::abs(p.position.x()), 1, 100 * precision);
      btManifoldPoint& point = bodies.manifold().getContactPoint(i);
      const btScalar impulse = p.position.x() > 0 ? btScalar(1) : btScalar(2);
      EXPECT_EQ(point.m_appliedImpulse, k > 0 ? impulse : 0);
      point.m_appliedImpulse = impulse;
    }
  }
  gContactEndedCallback = nullptr;
  EXPECT_EQ(contacts_ended, 0);
}

TEST(DROP_IN, AThinBodyKeepsItsPointsApart) {
  // The three points of its cap are nearer to one another than the breaking threshold.
  Bodies bodies(Cylinder(0.002, 1), crate);
  bodies.object(0).setWorldTransform(standing);
  for (int k = 0; k < 3; ++k) {
    bodies.step();
    EXPECT_EQ(bodies.points().size(), 3u);
  }
}

TEST(DROP_IN, ABodyThatIsNotThereAnyMoreHasNoPoints) {
  Bodies bodies(can, crate);
  bodies.object(0).setWorldTransform(standing);
  bodies.step();
  ASSERT_EQ(bodies.points().size(), 3u);
  for (const double z : {5.0, std::numeric_limits<double>::quiet_NaN()}) {
    bodies.object(0).setWorldTransform(at(0, 0, z));
    bodies.step();
    EXPECT_TRUE(bodies.points().empty()) << z;
  }
}

TEST(DROP_IN, AnswersContactPairTestWithItsDistance) {
  struct Nearest : btCollisionWorld::ContactResultCallback {
    btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
      distances.push_back(p.getDistance());
      return 0;
    }
    std::vector<double> distances;
  };
  Bodies bodies(can, crate);
  btDbvtBroadphase broadphase;
  btDefaultCollisionConfiguration configuration;
  btCollisionWorld world(&bodies.dispatcher, &broadphase, &configuration);
  bodies.object(0).setWorldTransform(at(0, 0, 2.3));
  Nearest nearest;
  nearest.m_closestDistanceThreshold = btScalar(0.5);
  world.contactPairTest(&bodies.object(0), &bodies.object(1), nearest);
  ASSERT_EQ(nearest.distances.size(), 3u);
  EXPECT_NEAR(nearest.distances[0], 0.3, 10 * precision);
}

/// Contacts of a can at the origin, upright along y, with another shape, as depths of the points.
std::vector<double> depths_with(btCollisionShape& other, double y, bool is_cured,
                                const btVector3& half_lengths) {
  btCylinderShape upright(half_lengths);
  Bodies bodies(can, crate, is_cured);
  bodies.object(0).setCollisionShape(&upright);
  bodies.object(1).setCollisionShape(&other);
  bodies.object(1).setWorldTransform(at(0.1, y, 0));
  bodies.step();
  std::vector<double> depths;
  for (const EnginePoint& p : bodies.points()) depths.push_back(p.depth);
  bodies.release();
  return depths;
}

constexpr btScalar half = btScalar(0.5);

TEST(DROP_IN, ACapsuleOfHeightZeroIsASphere) {
  btCapsuleShape ball(btScalar(0.25), 0);
  const auto depths = depths_with(ball, 0.7, true, {half, half, half});
  ASSERT_EQ(depths.size(), 1u);
  EXPECT_NEAR(depths[0], 0.05, 10 * precision);
}

TEST(DROP_IN, OtherSizesOfZeroStayBulletsOwn) {
  btSphereShape point(0);
  btCapsuleShape line(0, 1);
  btBoxShape plate(btVector3(2, 0, 2));
  btStaticPlaneShape ground(btVector3(0, 1, 0), 0);
  struct Case {
    btCollisionShape& other;
    double y;
    btVector3 half_lengths;
  };
  for (const auto& [other, y, half_lengths] :
       {Case{point, 0.45, {half, half, half}}, Case{line, 0.9, {half, half, half}},
        Case{plate, -0.45, {half, half, half}}, Case{ground, 0.01, {half, 0, half}}}) {
    SCOPED_TRACE(other.getName());
    const auto ours = depths_with(other, y, true, half_lengths);
    const bool bullet_has_none = &other == &point && !is_double;
    EXPECT_EQ(ours.empty(), bullet_has_none);
    EXPECT_EQ(ours, depths_with(other, y, false, half_lengths));
  }
}

/// Cans that fall on one another, a log that rolls and a capsule across a can, on a floor; returns
/// where they are after each second.
std::vector<btScalar> positions_of_falling_bodies() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  bullet::install(dispatcher);
  struct Thing {
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
  };
  std::vector<Thing> things;
  const auto add = [&](const Shape& shape, btScalar mass, int up, const btVector3& position) {
    Thing& thing = things.emplace_back();
    thing.shape = make_shape(shape, up);
    btVector3 inertia(0, 0, 0);
    if (mass > 0) thing.shape->calculateLocalInertia(mass, inertia);
    thing.body = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, thing.shape.get(), inertia));
    thing.body->setWorldTransform(btTransform(btQuaternion::getIdentity(), position));
    world.addRigidBody(thing.body.get());
  };
  world.setGravity(btVector3(0, 0, -10));
  add(Box(Vec3(9, 9, 1)), 0, 2, btVector3(0, 0, -1));
  for (const int i : {0, 1, 2}) {
    add(can, 1, 2, btVector3(btScalar(0.1 * i), 0, btScalar(1.01 + 2.02 * i)));
  }
  add(can, 1, 1, btVector3(-3, 0, btScalar(0.6)));
  add(Capsule(0.2, 0.5), 1, 0, btVector3(btScalar(-3.2), 0, btScalar(1.4)));
  things[4].body->setLinearVelocity(btVector3(btScalar(0.5), 0, 0));
  std::vector<btScalar> numbers;
  for (int second = 0; second < 3; ++second) {
    for (int step = 0; step < 60; ++step) world.stepSimulation(btScalar(1.0 / 60), 0);
    for (const Thing& thing : things) {
      const btVector3& x = thing.body->getWorldTransform().getOrigin();
      for (int i = 0; i < 3; ++i) numbers.push_back(x[i]);
    }
  }
  for (const Thing& thing : things) world.removeRigidBody(thing.body.get());
  return numbers;
}

// One world in each thread. Threads in one world are for a Bullet that is built with BT_THREADSAFE:
// without it, as Debian's is, the lock of btCollisionDispatcherMt is none and it has no scheduler.
TEST(DROP_IN, LetsThreadsStepWorldsAtOnce) {
  const auto alone = expect_threads_answer_alike([](int) { return positions_of_falling_bodies(); });
  for (const btScalar x : alone) EXPECT_TRUE(std::abs(x) < 9);  // nothing has fallen off the floor
}

TEST(DROP_IN, UninstallGivesBackBulletsOwnAnswers) {
  const auto answers = [](bool is_between) {
    std::vector<double> numbers;
    for (const Pair pair : pairs_of_sizes) {
      for (const Identity& id : everyday_poses(pair, 1)) {
        const Configuration c = make_configuration(id);
        Bodies bodies(c.a, c.b, false);
        if (is_between) bullet::install(bodies.dispatcher), bullet::uninstall(bodies.dispatcher);
        bodies.object(0).setWorldTransform(to_transform(c.a, c.pose_a, 2));
        bodies.object(1).setWorldTransform(to_transform(c.b, c.pose_b, 2));
        bodies.step();
        append(numbers, bodies.points());
      }
    }
    return numbers;
  };
  EXPECT_EQ(answers(true), answers(false));
}

}  // namespace
}  // namespace touchstone
