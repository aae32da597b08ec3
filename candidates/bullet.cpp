// Bullet 3.24, double precision (the -float64 libraries of Debian).
//
// Calls        The narrow phase that a world runs: the dispatcher's algorithm for the pair
//              (btConvexConvexAlgorithm with GJK and EPA's btGjkEpaPenetrationDepthSolver;
//              btConvexPlaneCollisionAlgorithm for the plane), kept with the pair as a world keeps
//              it, then processCollision into its manifold.
// Shapes       btCylinderShapeZ, btCapsuleShapeZ, btSphereShape, btBoxShape, btStaticPlaneShape.
// Margin       As Bullet makes them: min(0.04, a tenth of the smallest half extent) on cylinder and
// box,
//              taken from the inside, which keeps the faces where they are and rounds the edges;
//              for capsule and sphere the radius is the margin.
// Conventions  m_normalWorldOnB points from B to A of the manifold; its order is checked. A point
// is
//              midway between Bullet's positions on A and on B.
// Threshold    Bullet also reports points up to its contact breaking threshold apart (0.02 at
// most);
//              those beyond ours are left out.
// History      The manifold is emptied before every query. A world keeps up to four points over
// several
//              steps of motion; a single query gives one for most pairs.
#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <algorithm>
#include <memory>

#include "candidates/entry_points.h"

static_assert(sizeof(btScalar) == sizeof(double), "built against single-precision Bullet");

namespace {

std::unique_ptr<btCollisionShape> make_shape(const ts_shape& shape) {
  const double* s = shape.size;
  switch (shape.kind) {
    case TS_CYLINDER:
      return std::make_unique<btCylinderShapeZ>(btVector3(s[0], s[0], s[1]));
    case TS_PLANE:
      return std::make_unique<btStaticPlaneShape>(btVector3(s[0], s[1], s[2]), s[3]);
    case TS_SPHERE:
      return std::make_unique<btSphereShape>(s[0]);
    case TS_CAPSULE:
      return std::make_unique<btCapsuleShapeZ>(s[0], 2 * s[1]);
    case TS_BOX:
      return std::make_unique<btBoxShape>(btVector3(s[0], s[1], s[2]));
  }
  return nullptr;
}

btTransform to_transform(const ts_pose& p) {
  const double* q = p.orientation;
  return btTransform(btQuaternion(q[1], q[2], q[3], q[0]),
                     btVector3(p.position[0], p.position[1], p.position[2]));
}

void copy(const btVector3& from, double (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

/// The default configuration keeps pools for thousands of pairs; ours has one.
btDefaultCollisionConstructionInfo small_pools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 1;
  info.m_defaultMaxCollisionAlgorithmPoolSize = 1;
  return info;
}

/// A dispatcher with the pair's own algorithm; released in reverse order.
class Pair {
 public:
  Pair(const ts_shape& a, const ts_shape& b, double threshold)
      : threshold_(threshold),
        configuration_(small_pools()),
        dispatcher_(&configuration_),
        shape_a_(make_shape(a)),
        shape_b_(make_shape(b)) {
    object_a_.setCollisionShape(shape_a_.get());
    object_b_.setCollisionShape(shape_b_.get());
    const btCollisionObjectWrapper wrap_a = wrap(object_a_), wrap_b = wrap(object_b_);
    algorithm_ = dispatcher_.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  }
  ~Pair() {
    algorithm_->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm_);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  void query(const ts_pose& a, const ts_pose& b, ts_answer& answer) {
    object_a_.setWorldTransform(to_transform(a));
    object_b_.setWorldTransform(to_transform(b));
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      dispatcher_.getManifoldByIndexInternal(i)->clearManifold();
    }
    const btCollisionObjectWrapper wrap_a = wrap(object_a_), wrap_b = wrap(object_b_);
    btManifoldResult result(&wrap_a, &wrap_b);
    algorithm_->processCollision(&wrap_a, &wrap_b, info_, &result);
    answer.status = TS_NONE;
    answer.point_count = 0;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      read(*dispatcher_.getManifoldByIndexInternal(i), answer);
    }
  }

 private:
  static btCollisionObjectWrapper wrap(const btCollisionObject& object) {
    return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
  }

  void read(const btPersistentManifold& manifold, ts_answer& answer) const {
    const double sign = manifold.getBody0() == &object_a_ ? 1 : -1;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      // Written so that a distance that is not a number is reported, not dropped.
      if (point.getDistance() > threshold_) continue;
      if (answer.point_count == TOUCHSTONE_MAX_POINTS) break;
      ts_point& out = answer.points[answer.point_count++];
      copy((point.getPositionWorldOnA() + point.getPositionWorldOnB()) / 2, out.position);
      copy(sign * point.m_normalWorldOnB, out.normal);
      out.depth = -point.getDistance();
      if (answer.status == TS_NONE || point.getDistance() < answer.signed_distance) {
        answer.status = TS_CONTACT;
        answer.signed_distance = point.getDistance();
        std::copy(out.normal, out.normal + 3, answer.normal);
      }
    }
  }

  double threshold_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDispatcherInfo info_;
  std::unique_ptr<btCollisionShape> shape_a_, shape_b_;
  btCollisionObject object_a_, object_b_;
  btCollisionAlgorithm* algorithm_ = nullptr;
};

int supports(ts_shape_kind) { return 1; }

ts_prepared* prepare(const ts_shape* a, const ts_shape* b, double threshold) {
  return reinterpret_cast<ts_prepared*>(new Pair(*a, *b, threshold));
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, ts_answer* answer) {
  reinterpret_cast<Pair*>(prepared)->query(*a, *b, *answer);
}

void release(ts_prepared* prepared) { delete reinterpret_cast<Pair*>(prepared); }

}  // namespace

extern "C" const ts_candidate* touchstone_bullet(void) {
  static const ts_candidate candidate = {
      TOUCHSTONE_CANDIDATE_VERSION,
      "bullet",
      TOUCHSTONE_BULLET_VERSION,
      "double precision; the world's narrow phase (GJK/EPA, plane analytic), one query with an "
      "empty "
      "manifold; default margins: edges of cylinder and box rounded by min(0.04 m, a tenth of the "
      "smallest half extent); points midway between the two surfaces",
      supports,
      prepare,
      query,
      release};
  return &candidate;
}
