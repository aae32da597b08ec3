#pragma once

// Exact contacts of cylinders inside Bullet (3.24; single precision and BT_USE_DOUBLE_PRECISION):
// touchstone::bullet::install(dispatcher), before the world's bodies meet. The dispatcher then asks
// Touchstone for a btCylinderShape (X and Z too) against a cylinder, box, capsule, sphere or static
// plane, in both orders and as children of compounds. Hulls, triangles and sweeps stay Bullet's.
//
// Shapes       Have sharp edges: Bullet's margins round them but keep the faces, so that they count
//              for nothing here. A capsule of height 0 is a sphere; pairs with other sizes of 0 as
//              they begin to overlap stay Bullet's. Poses that are not finite have no contacts.
// Points       Up to 4; of more, those that span most. They are those of this step, each in the
//              place of an old one, whose impulses, lifetime and user data it keeps.
// Threshold    The manifold's breaking threshold, as with Bullet (contactPairTest adds its own): up
//              to there bodies that are apart have points, of positive distance.
// Conventions  The normal points from the manifold's second body to its first; friction, materials
//              and callbacks are btManifoldResult's. CF_HAS_FRICTION_ANCHOR keeps points as ever.
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btEmptyCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <btBulletCollisionCommon.h>
#include <utility>

#include "../contact_of.hpp"
#include "../reduce_points.hpp"
#include "../touchstone.hpp"

namespace touchstone::bullet::detail {

using Wrapper = btCollisionObjectWrapper;

inline Vec3 to_vec3(const btVector3& v) { return Vec3(v.x(), v.y(), v.z()); }
inline btVector3 to_bullet(const Vec3& v) {
  return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}
/// The pose of a shape whose axis is the body's x, y or z (0, 1, 2): Touchstone's is its z.
inline Pose pose_of(const btTransform& transform, int up_axis) {
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i)
    rotation.col(i) = to_vec3(transform.getBasis().getColumn((up_axis + 1 + i) % 3));
  return Pose(to_vec3(transform.getOrigin()), Eigen::Quaterniond(rotation));
}

/// A shape and its up axis. Throws InvalidInput for a shape that has no interior.
inline std::pair<Shape, int> to_shape(const btCollisionShape* shape) {
  const int type = shape->getShapeType();
  if (type == CYLINDER_SHAPE_PROXYTYPE) {
    const auto& s = static_cast<const btCylinderShape&>(*shape);
    return {Cylinder(s.getRadius(), s.getHalfExtentsWithMargin()[s.getUpAxis()]), s.getUpAxis()};
  }
  if (type == CAPSULE_SHAPE_PROXYTYPE) {
    const auto& s = static_cast<const btCapsuleShape&>(*shape);
    if (s.getHalfHeight() == 0) return {Sphere(s.getRadius()), 2};
    return {Capsule(s.getRadius(), s.getHalfHeight()), s.getUpAxis()};
  }
  if (type == SPHERE_SHAPE_PROXYTYPE)
    return {Sphere(static_cast<const btSphereShape*>(shape)->getRadius()), 2};
  if (type == BOX_SHAPE_PROXYTYPE)
    return {Box(to_vec3(static_cast<const btBoxShape*>(shape)->getHalfExtentsWithMargin())), 2};
  const auto& s = static_cast<const btStaticPlaneShape&>(*shape);
  return {Plane(to_vec3(s.getPlaneNormal()), s.getPlaneConstant()), 2};
}

/// Contact of a cylinder A with another shape B, with points up to `threshold` apart, no more than
/// a manifold holds.
inline Contact contact_of(const Wrapper& a, const Wrapper& b, double threshold) try {
  const auto [shape_a, up_a] = to_shape(a.getCollisionShape());
  const auto [shape_b, up_b] = to_shape(b.getCollisionShape());
  const Configuration bodies{std::get<Cylinder>(shape_a), pose_of(a.getWorldTransform(), up_a),
                             shape_b, pose_of(b.getWorldTransform(), up_b)};
  Contact c = contact(bodies, threshold, nullptr, PointRange::within_threshold);
  if constexpr (sizeof(btScalar) == 4) {
    reduce_points(c, MANIFOLD_CACHE_SIZE, 1e-6);
  } else {
    reduce_points(c, MANIFOLD_CACHE_SIZE, 1e-9, unseen_lack(bodies));
  }
  return c;
} catch (const InvalidInput&) {
  return {};
}

/// Hands a manifold over to new points: the nearest old point of each (in the frame of either body,
/// for one may roll) moves to where the manifold will look for it, and other old ones are removed.
inline void hand_over(btPersistentManifold& manifold, const btManifoldPoint* points, int count) {
  int kept = 0;
  for (; kept < btMin(count, manifold.getNumContacts()); ++kept) {
    const auto distance = [&](int i) {
      const btManifoldPoint& old = manifold.getContactPoint(i);
      return btMin(points[kept].m_localPointA.distance2(old.m_localPointA),
                   points[kept].m_localPointB.distance2(old.m_localPointB));
    };
    int nearest = kept;
    for (int i = kept + 1; i < manifold.getNumContacts(); ++i) {
      if (distance(i) < distance(nearest)) nearest = i;
    }
    btSwap(manifold.getContactPoint(kept), manifold.getContactPoint(nearest));
    manifold.getContactPoint(kept).m_localPointA = points[kept].m_localPointA;
  }
  for (int i = manifold.getNumContacts(); i-- > kept;) manifold.removeContactPoint(i);
}

/// What Bullet keeps with a pair that has a cylinder; it touches its own manifold alone.
class Algorithm : public btEmptyAlgorithm {  // which names no time of impact
 public:
  using btEmptyAlgorithm::btEmptyAlgorithm;
  ~Algorithm() override {
    if (manifold_) m_dispatcher->releaseManifold(manifold_);
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (manifold_) manifolds.push_back(manifold_);
  }
  void processCollision(const Wrapper* first, const Wrapper* second, const btDispatcherInfo&,
                        btManifoldResult* result) override {
    const auto *object = first->getCollisionObject(), *other = second->getCollisionObject();
    if (!manifold_) manifold_ = m_dispatcher->getNewManifold(object, other);
    if (!manifold_) return;  // Bullet's pool is full and may not grow
    result->setPersistentManifold(manifold_);
    const btScalar breaking = manifold_->getContactBreakingThreshold();
    const bool is_a = first->getCollisionShape()->getShapeType() == CYLINDER_SHAPE_PROXYTYPE;
    Contact c = contact_of(is_a ? *first : *second, is_a ? *second : *first,
                           breaking + result->m_closestPointDistanceThreshold);
    if ((manifold_->getBody0() == object) != is_a) c.normal = -c.normal;
    add_points(c, *result);
    result->refreshContactPoints();
  }

 private:
  /// Adds the points of a contact whose normal points from the manifold's second body to its first.
  void add_points(const Contact& c, btManifoldResult& result) {
    const btCollisionObject &body0 = *manifold_->getBody0(), &body1 = *manifold_->getBody1();
    const btVector3 normal = to_bullet(c.normal);
    btManifoldPoint points[MANIFOLD_CACHE_SIZE];
    int count = 0;
    for (const ContactPoint& p : c.points()) {
      btManifoldPoint& to = points[count++];
      to.m_positionWorldOnB = to_bullet(p.position + p.depth / 2 * c.normal);
      to.m_distance1 = btScalar(-p.depth);
      to.m_localPointA =
          body0.getWorldTransform().invXform(to.m_positionWorldOnB + normal * to.m_distance1);
      to.m_localPointB = body1.getWorldTransform().invXform(to.m_positionWorldOnB);
    }
    constexpr int anchor = btCollisionObject::CF_HAS_FRICTION_ANCHOR;
    const bool is_anchored = (body0.getCollisionFlags() | body1.getCollisionFlags()) & anchor;
    if (!is_anchored) hand_over(*manifold_, points, count);
    const btScalar breaking = manifold_->getContactBreakingThreshold();
    for (int i = 0; i < count; ++i) {
      // What is nearer than the threshold counts as the same point: of a thin body, all would.
      const btScalar near = btMin(btMax(points[i].m_distance1, breaking / 1000), breaking);
      manifold_->setContactBreakingThreshold(is_anchored ? breaking : near);
      result.addContactPoint(normal, points[i].m_positionWorldOnB, points[i].m_distance1);
    }
    manifold_->setContactBreakingThreshold(breaking);
  }

  btPersistentManifold* manifold_ = nullptr;
};

/// Makes algorithms; the pair of a shape that has no interior gets Bullet's own.
template <auto own>  // the configuration's member function that names those
struct CreateAlgorithm : btCollisionAlgorithmCreateFunc {
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& ci,
                                                 const Wrapper* a, const Wrapper* b) override try {
    to_shape(a->getCollisionShape()), to_shape(b->getCollisionShape());
    return new (ci.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Algorithm))) Algorithm(ci);
  } catch (const InvalidInput&) {
    const auto type = [](const Wrapper* w) { return w->getCollisionShape()->getShapeType(); };
    auto* all = static_cast<btCollisionDispatcher*>(ci.m_dispatcher1)->getCollisionConfiguration();
    return (all->*own)(type(a), type(b))->CreateCollisionAlgorithm(ci, a, b);
  }
};

/// Calls with the types of every pair that has a cylinder, in both orders.
template <class Call>
void for_pairs(Call call) {
  for (const int other : {CYLINDER_SHAPE_PROXYTYPE, BOX_SHAPE_PROXYTYPE, CAPSULE_SHAPE_PROXYTYPE,
                          SPHERE_SHAPE_PROXYTYPE, STATIC_PLANE_PROXYTYPE}) {
    call(CYLINDER_SHAPE_PROXYTYPE, other), call(other, CYLINDER_SHAPE_PROXYTYPE);
  }
}

}  // namespace touchstone::bullet::detail

namespace touchstone::bullet {

/// Gives every pair with a cylinder to Touchstone, while no thread collides. Pairs whose bounding
/// boxes overlap already keep the algorithm that they have until these part.
inline void install(btCollisionDispatcher& dispatcher) {
  using Own = btCollisionConfiguration;
  static detail::CreateAlgorithm<&Own::getCollisionAlgorithmCreateFunc> create;
  static detail::CreateAlgorithm<&Own::getClosestPointsAlgorithmCreateFunc> closest;
  detail::for_pairs([&](int i, int j) {
    dispatcher.registerCollisionCreateFunc(i, j, &create);
    dispatcher.registerClosestPointsCreateFunc(i, j, &closest);
  });
}

/// Gives them back to what the dispatcher's configuration names.
inline void uninstall(btCollisionDispatcher& dispatcher) {
  btCollisionConfiguration& own = *dispatcher.getCollisionConfiguration();
  detail::for_pairs([&](int i, int j) {
    dispatcher.registerCollisionCreateFunc(i, j, own.getCollisionAlgorithmCreateFunc(i, j));
    dispatcher.registerClosestPointsCreateFunc(i, j, own.getClosestPointsAlgorithmCreateFunc(i, j));
  });
}

}  // namespace touchstone::bullet
