// Bullet 3.24, compiled twice: in double precision (Debian's -float64 libraries) and in single.
//
// Calls        The narrow phase that a world runs: the dispatcher's algorithm for the pair
//              (btConvexConvexAlgorithm with GJK and EPA's btGjkEpaPenetrationDepthSolver;
//              btConvexPlaneCollisionAlgorithm for the plane), kept with the pair as a world keeps
//              it, then processCollision into its manifold.
// Shapes       btCylinderShapeZ, btCapsuleShapeZ, btSphereShape, btBoxShape, btStaticPlaneShape;
//              btConvexHullShape of a convex body's vertices, be it flat or not.
// Margin       bullet: as Bullet makes them, min(0.04, a tenth of the smallest half extent) on
//              cylinder and box, taken from the inside, which keeps the faces where they are and
//              rounds the edges; for capsule and sphere the radius is the margin.
//              btConvexHullShape has it outside: a convex body is 0.04 larger on all sides.
//              bullet-margin-0: setMargin(0) on cylinder, box and hull, for sharp edges.
//              What they model is so the body with that rounding, and nothing else: GJK works on
//              the shapes without margins, and EPA and the plane's algorithm on
//              localGetSupportingVertex, which of a cylinder adds a ball of the margin, too. A
//              shape that is given with a rounding gets it as its margin. bullet-hull:N:
//              btConvexHullShape of the prism's corners with margin 0.
// Conventions  m_normalWorldOnB points from B to A of the manifold; its order is checked. A point
//              is midway between Bullet's positions on A and on B.
// Threshold    Bullet also reports points up to its contact breaking threshold apart (at most
//              0.02); those beyond ours are dropped.
// History      The manifold is emptied before every query: one query gives one point for most
//              pairs. bullet-persistent has the manifold of a world after some steps: the pose is
//              queried four times, rocked by 1 mrad about the world's x and y axes, then as it is;
//              Bullet refreshes the manifold's points, up to four. Its time is that of all five
//              queries.
// Cured        With TOUCHSTONE_CURED, Touchstone's contacts are installed in the dispatcher
//              (reference/engines/bullet.hpp), and the candidate is bullet+touchstone.
// Casts        btCollisionWorld::objectQuerySingle, as convexSweepTest asks of each body in
//              the way, with no allowed penetration.
// Precision    In single precision the poses are rounded to float, as an engine holds them.
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <algorithm>
#include <memory>
#include <span>

#include "candidates/adapter.hpp"
#include "candidates/bullet_pair.hpp"
#include "candidates/cast.h"
#include "candidates/model.hpp"

namespace {

/// How one of this file's candidates calls Bullet.
struct Setting {
  bool sharp = false;   ///< margin 0
  bool rocked = false;  ///< several steps into one manifold
  int sides = 0;        ///< of the prism that stands for a cylinder; zero: a cylinder
};

using touchstone::to_scalar;

std::unique_ptr<btConvexHullShape> make_hull(std::span<const double> coordinates) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (std::size_t i = 0; i < coordinates.size(); i += 3) {
    shape->addPoint(btVector3(to_scalar(coordinates[i]), to_scalar(coordinates[i + 1]),
                              to_scalar(coordinates[i + 2])),
                    false);
  }
  shape->recalcLocalAabb();
  return shape;
}

std::unique_ptr<btConvexHullShape> make_prism(int sides, const double (&size)[4]) {
  const auto prism = touchstone::RoundedPolytope::prism(sides, size[0], size[1]);
  return make_hull({prism.vertices().front().data(), 3 * prism.vertices().size()});
}

std::unique_ptr<btCollisionShape> make_shape(const ts_shape& shape, const Setting& setting) {
  btScalar s[4];
  std::transform(shape.size, shape.size + 4, s, to_scalar);
  const auto with_margin = [&](auto made) -> std::unique_ptr<btCollisionShape> {
    if (setting.sharp || shape.rounding > 0) made->setMargin(to_scalar(shape.rounding));
    return made;
  };
  switch (shape.kind) {
    case TS_CYLINDER:
      if (setting.sides > 0) return with_margin(make_prism(setting.sides, shape.size));
      return with_margin(std::make_unique<btCylinderShapeZ>(btVector3(s[0], s[0], s[1])));
    case TS_PLANE:
      return std::make_unique<btStaticPlaneShape>(btVector3(s[0], s[1], s[2]), s[3]);
    case TS_SPHERE:
      return std::make_unique<btSphereShape>(s[0]);
    case TS_CAPSULE:
      return std::make_unique<btCapsuleShapeZ>(s[0], 2 * s[1]);
    case TS_BOX:
      return with_margin(std::make_unique<btBoxShape>(btVector3(s[0], s[1], s[2])));
    case TS_CONVEX:
      return with_margin(make_hull(touchstone::coordinates_of(shape)));
  }
  return nullptr;
}

}  // namespace

struct ts_prepared {
  touchstone::BulletPair pair;
  std::unique_ptr<touchstone::ModelPair> model;  ///< of bullet-hull
};

namespace {

constexpr bool single_precision = sizeof(btScalar) == sizeof(float);

constexpr Setting usual;

template <Setting setting>
ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double) {
  return new ts_prepared{
      {make_shape(*a, setting), make_shape(*b, setting), threshold, setting.rocked}, nullptr};
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
           ts_answer* answer) {
  prepared->pair.query(*a, *b, *answer);
}

[[maybe_unused]] void roundings(const ts_prepared* prepared, double* of_a, double* of_b) {
  *of_a = prepared->pair.rounding_a();
  *of_b = prepared->pair.rounding_b();
}

using touchstone::adapter::release, touchstone::adapter::supports_all,
    touchstone::adapter::supports_primitives;

#define NAME(rest) (single_precision ? "bullet-float" rest : "bullet" rest)
#define SETTINGS(rest) (single_precision ? "single precision; " rest : "double precision; " rest)
#define CALLS \
  "the world's narrow phase (GJK/EPA, plane analytic); points midway between the two surfaces; "

#ifdef TOUCHSTONE_CURED

const ts_candidate candidates[] = {
    {NAME("+touchstone"), TOUCHSTONE_BULLET_VERSION,
     SETTINGS("the world's narrow phase with Touchstone's contacts of cylinders installed, at most "
              "4 points, midway between the two surfaces; one query with an empty manifold; sharp "
              "edges"),
     nullptr, nullptr, supports_primitives, prepare<usual>, query, release, nullptr, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

#else

constexpr Setting sharp{true, false}, rocked{false, true};

ts_prepared* prepare_hull(void*, const ts_shape* a, const ts_shape* b, double threshold,
                          double sides) {
  if (a->rounding > 0 || b->rounding > 0) return nullptr;  // the model's distance has none
  const int n = static_cast<int>(sides);
  const auto prism = [n](double radius, double half_length) {
    return touchstone::inscribed_prism(n, radius, half_length);
  };
  const Setting setting{true, false, n};
  return new ts_prepared{{make_shape(*a, setting), make_shape(*b, setting), threshold, false},
                         std::make_unique<touchstone::ModelPair>(*a, *b, prism)};
}

double hull_distance(ts_prepared* prepared, const ts_pose* a, const ts_pose* b) {
  return prepared->model->separation(*a, *b).distance;
}

const ts_parameter sides = {"number of sides", 3, 128, 16, 1, 0};

const ts_candidate candidates[] = {
    {NAME(""), TOUCHSTONE_BULLET_VERSION,
     SETTINGS(CALLS "one query with an empty manifold; default margins: edges of cylinder and box "
                    "rounded by min(0.04 m, a tenth of the smallest half extent), convex bodies "
                    "0.04 m larger"),
     nullptr, nullptr, supports_all, prepare<usual>, query, release, nullptr, nullptr},
    {NAME("-margin-0"), TOUCHSTONE_BULLET_VERSION,
     SETTINGS(CALLS "one query with an empty manifold; margin 0 on cylinder, box and convex body"),
     nullptr, nullptr, supports_all, prepare<sharp>, query, release, nullptr, nullptr},
    {NAME("-persistent"), TOUCHSTONE_BULLET_VERSION,
     SETTINGS(CALLS "the manifold after five queries, four of them rocked by 1 mrad; default "
                    "margins; the time is that of all five"),
     nullptr, nullptr, supports_all, prepare<rocked>, query, release, nullptr, nullptr},
    {NAME("-hull"), TOUCHSTONE_BULLET_VERSION,
     SETTINGS(CALLS "one query with an empty manifold; btConvexHullShape and box with margin 0"),
     "every cylinder as the regular prism with its corners on the rims", &sides, supports_all,
     prepare_hull, query, release, hull_distance, nullptr}};

// In single precision the last two would show nothing new.
const ts_plugin plugin = {
    TOUCHSTONE_INTERFACE_VERSION, single_precision ? 2 : 4, candidates, nullptr, 0, roundings};

#endif

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }

#ifndef TOUCHSTONE_CURED

void touchstone_cast(int candidate, const ts_shape* a, const ts_shape* b, const ts_pose* pose_a,
                     const ts_pose* pose_b, const double sweep[3], ts_cast* answer) {
  answer->status = TS_CAST_UNSUPPORTED;
  if (candidate > 1) return;  // the others differ in contacts alone
  const Setting setting = candidate == 1 ? sharp : usual;
  const auto shape_a = make_shape(*a, setting), shape_b = make_shape(*b, setting);
  btCollisionObject object;
  object.setCollisionShape(shape_b.get());
  object.setWorldTransform(touchstone::to_transform(*pose_b));
  const btTransform from = touchstone::to_transform(*pose_a);
  const btTransform to(
      from.getRotation(),
      from.getOrigin() + btVector3(to_scalar(sweep[0]), to_scalar(sweep[1]), to_scalar(sweep[2])));
  btCollisionWorld::ClosestConvexResultCallback hit(from.getOrigin(), to.getOrigin());
  btCollisionWorld::objectQuerySingle(static_cast<const btConvexShape*>(shape_a.get()), from, to,
                                      &object, shape_b.get(), object.getWorldTransform(), hit, 0);
  answer->status = hit.hasHit() ? TS_CAST_TOUCH : TS_CAST_NEVER;
  answer->fraction = double{hit.m_closestHitFraction};
  if (hit.hasHit()) touchstone::adapter::copy(hit.m_hitNormalWorld, answer->normal);
}

#endif
