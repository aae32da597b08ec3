// ODE's dCollide with the drop-in.
#include "reference/engines/ode.hpp"

#include <deque>

#include "candidates/ode_library.hpp"
#include "reference/engines/drop_in_test.hpp"
#include "simulation/ode_scene.hpp"

namespace touchstone {
namespace {

class Geoms {
  OdeMeshes meshes_;

 public:
  explicit Geoms(const Configuration& c)
      : a(make_ode_geom(nullptr, c.a, nullptr, c.pose_a, meshes_)),
        b(make_ode_geom(nullptr, c.b, nullptr, c.pose_b, meshes_)) {}
  ~Geoms() {
    dGeomDestroy(a);
    dGeomDestroy(b);
  }
  Geoms(const Geoms&) = delete;
  Geoms& operator=(const Geoms&) = delete;
  dGeomID a, b;
};

constexpr int all_points = 16;

/// Normals from the second geom to the first.
std::vector<EnginePoint> collide(dGeomID first, dGeomID second, int max_points = all_points) {
  dContact contacts[all_points];  // the geometry lies at a stride within them
  const int count = dCollide(first, second, max_points, &contacts[0].geom, sizeof(dContact));
  std::vector<EnginePoint> points;
  for (int i = 0; i < count; ++i) {
    const dContactGeom& c = contacts[i].geom;
    EXPECT_EQ(c.g1, first);
    EXPECT_EQ(c.g2, second);
    points.push_back({Vec3(c.pos), Vec3(c.normal), c.depth});
  }
  return points;
}

void expect_in_both_orders(const Configuration& c, dGeomID a, dGeomID b) {
  expect_as_ours(c, 0, 8, collide(a, b), 1e-12);
  expect_as_ours(c, 0, 8, turned_round(collide(b, a)), 1e-12);
}

class OdeDropIn : public testing::Test {
 protected:
  static void SetUpTestSuite() { initialise_ode(); }
  void SetUp() override { ode::install(); }
  void TearDown() override { ode::uninstall(); }
};

TEST_F(OdeDropIn, AnswersEveryPairInBothOrders) {
  for (const Pair pair : pairs_of_sizes) {
    for (const Identity& id : everyday_poses(pair, 10)) {
      const Configuration c = make_configuration(id);
      SCOPED_TRACE(to_string(id));
      const Geoms geoms(c);
      expect_in_both_orders(c, geoms.a, geoms.b);
    }
  }
}

/// A face's edges cut a cap that stands on it: more points than most callers ask for.
const Configuration cut_cap{Cylinder(1, 1), Pose(Vec3(0.3, 0.2, 1.99)), Box({1, 0.9, 1}), Pose()};

TEST_F(OdeDropIn, GivesAsManyPointsAsAreAskedForAndWritesNoMore) {
  const Geoms geoms(cut_cap);
  const std::size_t all = collide(geoms.a, geoms.b).size();
  ASSERT_GT(all, 4u);
  for (int limit = 1; limit <= 8; ++limit) {
    const auto points = collide(geoms.a, geoms.b, limit);
    EXPECT_EQ(points.size(), std::min<std::size_t>(limit, all));
    for (const EnginePoint& p : points) EXPECT_NEAR(p.depth, 0.01, 1e-12);
    dContactGeom contacts[9] = {};
    contacts[limit].depth = -1;
    dCollide(geoms.a, geoms.b, limit, contacts, sizeof(dContactGeom));
    EXPECT_EQ(contacts[limit].depth, -1);
  }
}

// A needle that leans by a hair rises by part of its width: which end is the lower one shows.
TEST_F(OdeDropIn, GivesTheDeepestPointOfANeedleThatLeansByAHair) {
  constexpr double radius = 1e-5, promised = 1e-6;  // of the smaller size
  const double c = std::sqrt(0.5);
  for (const double lean : {-3e-10, 3e-10}) {
    const Configuration lying{Cylinder(radius, 1),
                              Pose(Vec3(0, 0, 0.9 * radius), {c, c * (1 + lean / 2), 0, 0}),
                              Plane(Vec3(0, 0, 1), 0), Pose()};
    const Geoms geoms(lying);
    const auto points = collide(geoms.a, geoms.b, 1);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].depth, -signed_distance(lying).value, promised * radius) << lean;
  }
}

TEST_F(OdeDropIn, AnswersGeomsWithOffsetsAndInSpaces) {
  const dWorldID world = dWorldCreate();
  const dBodyID body = dBodyCreate(world);
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  const dGeomID box = dCreateBox(nullptr, 4, 4, 2), can = dCreateCylinder(space, 0.5, 2);
  dGeomSetBody(can, body);
  dGeomSetOffsetPosition(can, 0, 0, 0.5);
  dBodySetPosition(body, 0, 0, 1.49);
  EXPECT_EQ(collide(can, box).size(), 3u);
  dContactGeom contacts[8];
  EXPECT_EQ(dCollide(reinterpret_cast<dGeomID>(space), box, 8, contacts, sizeof(dContactGeom)), 3);
  EXPECT_NEAR(contacts[0].depth, 0.01, 1e-12);
  dSpaceDestroy(space);
  dGeomDestroy(box);
  dWorldDestroy(world);
}

/// A body somewhere in a world, for geoms that are not where their body is.
struct TurnedBody {
  TurnedBody() : world(dWorldCreate()), body(dBodyCreate(world)) {
    const dQuaternion turned = {0.5, 0.1, -0.7, 0.5};
    dBodySetPosition(body, 0.3, -0.2, 0.1);
    dBodySetQuaternion(body, turned);
  }
  ~TurnedBody() { dWorldDestroy(world); }
  TurnedBody(const TurnedBody&) = delete;
  TurnedBody& operator=(const TurnedBody&) = delete;

  /// Lends the body to a geom that stays where it is; returns the geom to collide.
  dGeomID with_offset(dGeomID geom) const {
    const dVector3 x = {dGeomGetPosition(geom)[0], dGeomGetPosition(geom)[1],
                        dGeomGetPosition(geom)[2]};
    dQuaternion q;
    dGeomGetQuaternion(geom, q);
    dGeomSetBody(geom, body);
    dGeomSetOffsetWorldPosition(geom, x[0], x[1], x[2]);
    dGeomSetOffsetWorldQuaternion(geom, q);
    return geom;
  }
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"  // of dGeomTransform, still in use
  dGeomID in_transform(dGeomID geom) const {
    dVector3 x;
    const dReal* at = dGeomGetPosition(geom);
    dBodyGetPosRelPoint(body, at[0], at[1], at[2], x);
    dMatrix3 rotation;
    dMultiply1_333(rotation, dBodyGetRotation(body), dGeomGetRotation(geom));
    dGeomSetPosition(geom, x[0], x[1], x[2]);
    dGeomSetRotation(geom, rotation);
    const dGeomID transform = dCreateGeomTransform(nullptr);
    dGeomTransformSetGeom(transform, geom);
    dGeomTransformSetInfo(transform, 1);  // contacts name the transform
    dGeomSetBody(transform, body);
    return transform;
  }
#pragma GCC diagnostic pop
  dWorldID world;
  dBodyID body;
};

TEST_F(OdeDropIn, AnswersTurnedGeomsInTransformsAndWithOffsetsInBothOrders) {
  for (const Pair pair : pairs_of_sizes) {
    for (const Identity& id : everyday_poses(pair, 3)) {
      const Configuration c = make_configuration(id);
      SCOPED_TRACE(to_string(id));
      for (const auto attach : {&TurnedBody::with_offset, &TurnedBody::in_transform}) {
        const Geoms geoms(c);
        const TurnedBody body, other_body;
        const dGeomID a = (body.*attach)(geoms.a);
        expect_in_both_orders(c, a, geoms.b);
        const dGeomID b = pair == Pair::plane ? geoms.b : (other_body.*attach)(geoms.b);
        expect_in_both_orders(c, a, b);
        if (a != geoms.a) dGeomDestroy(a);
        if (b != geoms.b) dGeomDestroy(b);
      }
    }
  }
}

TEST_F(OdeDropIn, ACapsuleOfZeroLengthIsASphere) {
  const Configuration c{Cylinder(0.5, 0.5), Pose(), Sphere(0.25), Pose(Vec3(0, 0.1, 0.7))};
  OdeMeshes meshes;
  const dGeomID can = make_ode_geom(nullptr, c.a, nullptr, c.pose_a, meshes);
  const dGeomID capsule = dCreateCapsule(nullptr, 0.25, 0);
  dGeomSetPosition(capsule, 0, 0.1, 0.7);
  expect_in_both_orders(c, can, capsule);
  const auto points = collide(capsule, can);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].depth, 0.05, 1e-12);
  EXPECT_NEAR(points[0].normal.z(), 1, 1e-12);
  dGeomDestroy(can);
  dGeomDestroy(capsule);
}

TEST_F(OdeDropIn, OtherSizesOfZeroStayOdesOwnWhereItHasAnAnswer) {
  const dGeomID can = dCreateCylinder(nullptr, 0.5, 1), disc = dCreateCylinder(nullptr, 0.5, 0);
  const dGeomID plane = dCreatePlane(nullptr, 0, 0, 1, -0.45), box = dCreateBox(nullptr, 4, 4, 2);
  const dGeomID point = dCreateSphere(nullptr, 0), line = dCreateCapsule(nullptr, 0, 1);
  dGeomSetPosition(disc, 0, 0, -0.46);
  dGeomSetPosition(box, 0, 0, -1.4);
  dGeomSetPosition(point, 0, 0, 0.45);
  dGeomSetPosition(line, 0.1, 0, 0.9);
  const auto answer = [](dGeomID a, dGeomID b) {
    std::vector<double> numbers;
    append(numbers, collide(a, b));
    return numbers;
  };
  for (const auto& [a, b] : {std::pair(can, point), std::pair(can, line), std::pair(disc, plane),
                             std::pair(disc, box)}) {
    const auto in_order = answer(a, b), exchanged = answer(b, a);
    ode::uninstall();
    EXPECT_FALSE(in_order.empty());
    EXPECT_EQ(in_order, answer(a, b));
    EXPECT_EQ(exchanged, answer(b, a));
    ode::install();
  }
  for (const dGeomID geom : {can, disc, plane, box, point, line}) dGeomDestroy(geom);
}

TEST_F(OdeDropIn, HasNoContactWhereOdeWouldEndTheProcess) {
  const dGeomID can = dCreateCylinder(nullptr, 0.5, 1), disc = dCreateCylinder(nullptr, 0.5, 0);
  const dGeomID plate = dCreateBox(nullptr, 4, 4, 0), capsule = dCreateCapsule(nullptr, 0.3, 1);
  dGeomSetPosition(capsule, 0, 0, 0.3);
  for (const auto& [a, b] :
       {std::pair(can, plate), std::pair(can, disc), std::pair(disc, capsule)}) {
    EXPECT_TRUE(collide(a, b).empty());
    EXPECT_TRUE(collide(b, a).empty());
  }
  for (const dGeomID geom : {can, disc, plate, capsule}) dGeomDestroy(geom);
}

TEST_F(OdeDropIn, HasNoContactWithAPoseThatIsNotFinite) {
  const Geoms geoms(cut_cap);
  dGeomSetPosition(geoms.a, NAN, 0, 0);
  EXPECT_TRUE(collide(geoms.a, geoms.b).empty());
}

TEST_F(OdeDropIn, LetsThreadsCollideAtOnce) {
  // Made before the threads start: ODE hands a destroyed geom's pose on to whoever makes the next,
  // by an atomic exchange that ThreadSanitizer, which does not see into ODE, takes for a race.
  std::deque<Geoms> geoms[3];
  for (auto& of_thread : geoms) {
    for (const Identity& id : everyday_poses(Pair::cylinder, 2)) {
      of_thread.emplace_back(make_configuration(id));
    }
  }
  expect_threads_answer_alike([&](int thread) {
    if (thread > 0) dAllocateODEDataForThread(dAllocateMaskAll);
    std::vector<double> numbers;
    for (const Geoms& pair : geoms[thread]) append(numbers, collide(pair.a, pair.b));
    if (thread > 0) dCleanupODEAllDataForThread();
    return numbers;
  });
}

TEST_F(OdeDropIn, UninstallGivesBackOdesOwnAnswers) {
  const auto answers = [] {
    std::vector<double> numbers;
    for (const Pair pair : pairs_of_sizes) {
      for (const Identity& id : everyday_poses(pair, 3)) {
        const Geoms geoms(make_configuration(id));
        append(numbers, collide(geoms.a, geoms.b));
        append(numbers, collide(geoms.b, geoms.a));
      }
    }
    return numbers;
  };
  expect_uninstall_gives_back(answers, ode::install, [] { EXPECT_TRUE(ode::uninstall()); });
}

}  // namespace
}  // namespace touchstone
