#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <algorithm>
#include <memory>
#include <utility>

#include "candidates/adapter.hpp"
#ifdef TOUCHSTONE_CURED
#include "reference/engines/bullet.hpp"
#endif

// The narrow phase that a world of Bullet runs, for one pair of shapes.
namespace touchstone {

inline btScalar to_scalar(double value) { return static_cast<btScalar>(value); }

inline btTransform to_transform(const ts_pose& p) {
  btScalar q[4], x[3];
  std::transform(p.orientation, p.orientation + 4, q, to_scalar);
  std::transform(p.position, p.position + 3, x, to_scalar);
  return btTransform(btQuaternion(q[1], q[2], q[3], q[0]), btVector3(x[0], x[1], x[2]));
}

/// Made once: to ask for the algorithm of every pair of shapes takes longer than most answers.
class NarrowPhase {
 public:
  NarrowPhase() : configuration_(small_pools()), dispatcher_(&configuration_) {
#ifdef TOUCHSTONE_CURED
    touchstone::bullet::install(dispatcher_);
#endif
  }
  static btCollisionDispatcher& dispatcher() {
    static NarrowPhase made;
    return made.dispatcher_;
  }

 private:
  /// The default configuration keeps pools for thousands of pairs; a session has few.
  static btDefaultCollisionConstructionInfo small_pools() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = 1;
    info.m_defaultMaxCollisionAlgorithmPoolSize = 1;
    return info;
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
};

/// The pair's own algorithm, which has its own manifolds; released in reverse order.
class BulletPair {
 public:
  using Made = std::unique_ptr<btCollisionShape>;

  /// `rocked`: every query is five into one manifold.
  BulletPair(Made a, Made b, double threshold, bool rocked)
      : threshold_(threshold),
        rocked_(rocked),
        dispatcher_(NarrowPhase::dispatcher()),
        shape_a_(std::move(a)),
        shape_b_(std::move(b)) {
    object_a_.setCollisionShape(shape_a_.get());
    object_b_.setCollisionShape(shape_b_.get());
    const btCollisionObjectWrapper wrap_a = wrap(object_a_), wrap_b = wrap(object_b_);
    algorithm_ = dispatcher_.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  }
  ~BulletPair() {
    algorithm_->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm_);
  }
  BulletPair(const BulletPair&) = delete;
  BulletPair& operator=(const BulletPair&) = delete;

  /// Has gContactAddedCallback called for its points.
  void call_back() { object_b_.setCollisionFlags(btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK); }

  double rounding_a() const { return rounding(*shape_a_); }
  double rounding_b() const { return rounding(*shape_b_); }

  void query(const ts_pose& a, const ts_pose& b, ts_answer& answer) {
    for (int i = 0; i < manifolds_.size(); ++i) manifolds_[i]->clearManifold();
    const btTransform at_a = to_transform(a);
    object_b_.setWorldTransform(to_transform(b));
    if (rocked_) {
      for (const btVector3& axis :
           {btVector3(1, 0, 0), btVector3(-1, 0, 0), btVector3(0, 1, 0), btVector3(0, -1, 0)}) {
        const btQuaternion rock(axis, to_scalar(1e-3));
        process(btTransform(rock * at_a.getRotation(), at_a.getOrigin()));
      }
    }
    process(at_a);
    // Some algorithms make it with their first answer.
    if (manifolds_.size() == 0) algorithm_->getAllContactManifolds(manifolds_);
    adapter::begin(answer);
    for (int i = 0; i < manifolds_.size(); ++i) read(*manifolds_[i], answer);
  }

 private:
  /// The margin of a shape whose edges it rounds; that of a sphere or capsule is its radius.
  static double rounding(const btCollisionShape& shape) {
    const int type = shape.getShapeType();
    const bool has_edges = type == CYLINDER_SHAPE_PROXYTYPE || type == BOX_SHAPE_PROXYTYPE ||
                           type == CONVEX_HULL_SHAPE_PROXYTYPE;
    return has_edges ? shape.getMargin() : 0;
  }

  void process(const btTransform& a) {
    object_a_.setWorldTransform(a);
    const btCollisionObjectWrapper wrap_a = wrap(object_a_), wrap_b = wrap(object_b_);
    btManifoldResult result(&wrap_a, &wrap_b);
    algorithm_->processCollision(&wrap_a, &wrap_b, info_, &result);
  }

  static btCollisionObjectWrapper wrap(const btCollisionObject& object) {
    return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
  }

  void read(const btPersistentManifold& manifold, ts_answer& answer) const {
    const btScalar sign = manifold.getBody0() == &object_a_ ? 1 : -1;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      // Written so that NaN is reported, not dropped.
      if (point.getDistance() > threshold_) continue;
      adapter::add_point(btVector3((point.getPositionWorldOnA() + point.getPositionWorldOnB()) / 2),
                         btVector3(sign * point.m_normalWorldOnB), double{point.getDistance()},
                         answer);
    }
  }

  double threshold_;
  bool rocked_;
  btCollisionDispatcher& dispatcher_;
  btDispatcherInfo info_;
  Made shape_a_, shape_b_;
  btCollisionObject object_a_, object_b_;
  btCollisionAlgorithm* algorithm_ = nullptr;
  btManifoldArray manifolds_;  // the algorithm's
};

}  // namespace touchstone
