#pragma once

// Exact contacts of cylinders inside Bullet: include this and call
// touchstone::bullet::install(dispatcher) before the world's bodies meet. The dispatcher then asks
// Touchstone for every pair with a btCylinderShape, X or Z (against cylinder, box, capsule, sphere,
// static plane, in both orders, as children of compounds too); other pairs, hulls and triangles
// among them, stay Bullet's own, and so do sweeps and continuous detection.
//
// Shapes       As users give them, with sharp edges: Bullet keeps the faces where they are and
//              rounds edges by the margin, so that margins change nothing here.
// Points       Up to 4, as a manifold holds; of more, those that span most (reduce_points.hpp). A
//              manifold has the points of this step alone, each in the place of the nearest of the
//              last step, whose impulses, lifetime and user data it keeps; Bullet's own keeps
//              points until they have slid by the breaking threshold, which holds a rolling log
//              back.
// Threshold    The manifold's contact breaking threshold: bodies closer than it have points of
//              positive distance, as with Bullet's own (with contactPairTest also its distance).
// Conventions  Bullet's: the normal points from the manifold's second body to its first. Friction
//              directions, materials and callbacks are those of btManifoldResult.
// Anchors      Of bodies with CF_HAS_FRICTION_ANCHOR, points stay as long as Bullet lets them.
// Threads      An algorithm touches its own manifold alone. Install while no thread collides.
// Invalid      Sizes of zero, and poses that are not finite, have no contacts.
// Versions     3.24, in single precision and with BT_USE_DOUBLE_PRECISION.
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <btBulletCollisionCommon.h>
#include <limits>
#include <utility>

#include "../reduce_points.hpp"
#include "../touchstone.hpp"

namespace touchstone::bullet {
namespace detail {

inline Vec3 to_vec3(const btVector3& v) { return Vec3(v.x(), v.y(), v.z()); }
inline btVector3 to_bullet(const Vec3& v) {
  return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}

/// The pose of a shape whose axis is the body's x, y or z (0, 1, 2): Touchstone's is its z.
inline Pose pose_of(const btTransform& transform, int up_axis = 2) {
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i) {
    rotation.col(i) = to_vec3(transform.getBasis().getColumn((up_axis + 1 + i) % 3));
  }
  return Pose(to_vec3(transform.getOrigin()), Eigen::Quaterniond(rotation));
}

template <class BulletShape>
const BulletShape& as(const btCollisionShape* shape) {
  return *static_cast<const BulletShape*>(shape);
}
inline Cylinder to_cylinder(const btCylinderShape& s) {
  return Cylinder(s.getRadius(), s.getHalfExtentsWithMargin()[s.getUpAxis()]);
}

/// Contact of a cylinder A with another shape B, with all points up to `threshold` apart.
inline Contact contact_of(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                          double threshold) try {
  const auto& cylinder = as<btCylinderShape>(a.getCollisionShape());
  const btCollisionShape* const other = b.getCollisionShape();
  const btTransform& at_b = b.getWorldTransform();
  const auto with = [&](const auto& shape_b, const Pose& pose_b) {
    return contact(to_cylinder(cylinder), pose_of(a.getWorldTransform(), cylinder.getUpAxis()),
                   shape_b, pose_b, threshold);
  };
  switch (other->getShapeType()) {
    case CYLINDER_SHAPE_PROXYTYPE:
      return with(to_cylinder(as<btCylinderShape>(other)),
                  pose_of(at_b, as<btCylinderShape>(other).getUpAxis()));
    case BOX_SHAPE_PROXYTYPE:
      return with(Box(to_vec3(as<btBoxShape>(other).getHalfExtentsWithMargin())), pose_of(at_b));
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = as<btCapsuleShape>(other);
      return with(Capsule(capsule.getRadius(), capsule.getHalfHeight()),
                  pose_of(at_b, capsule.getUpAxis()));
    }
    case SPHERE_SHAPE_PROXYTYPE:
      return with(Sphere(as<btSphereShape>(other).getRadius()), Pose(to_vec3(at_b.getOrigin())));
    default: {
      const auto& plane = as<btStaticPlaneShape>(other);
      return with(Plane(to_vec3(plane.getPlaneNormal()), plane.getPlaneConstant()), pose_of(at_b));
    }
  }
} catch (const InvalidInput&) {
  Contact none;
  none.normal.setZero();
  none.signed_distance = 0;
  return none;
}

/// Hands a manifold of the last step over to these points. The nearest old point of each (in the
/// frame of either body, for one of them may roll) moves to where the manifold will look for it;
/// the other old points are removed.
inline void hand_over(btPersistentManifold& manifold, const btManifoldPoint* points, int count) {
  bool is_kept[MANIFOLD_CACHE_SIZE] = {}, is_placed[MANIFOLD_CACHE_SIZE] = {};
  for (int n = btMin(count, manifold.getNumContacts()); n > 0; --n) {
    int nearest = -1, next = -1;
    btScalar least = std::numeric_limits<btScalar>::infinity();
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& old = manifold.getContactPoint(i);
      for (int k = 0; k < count && !is_kept[i]; ++k) {
        const btScalar distance = btMin(points[k].m_localPointA.distance2(old.m_localPointA),
                                        points[k].m_localPointB.distance2(old.m_localPointB));
        if (!is_placed[k] && distance < least) least = distance, nearest = i, next = k;
      }
    }
    if (nearest < 0) break;
    is_kept[nearest] = is_placed[next] = true;
    manifold.getContactPoint(nearest).m_localPointA = points[next].m_localPointA;
  }
  for (int i = manifold.getNumContacts() - 1; i >= 0; --i) {
    if (!is_kept[i]) manifold.removeContactPoint(i);
  }
}

/// What Bullet keeps with a pair of shapes of which one is a cylinder.
class Algorithm : public btCollisionAlgorithm {
 public:
  explicit Algorithm(const btCollisionAlgorithmConstructionInfo& info)
      : btCollisionAlgorithm(info), manifold_(info.m_manifold), is_shared_(manifold_) {}
  ~Algorithm() override {
    if (manifold_ && !is_shared_) m_dispatcher->releaseManifold(manifold_);
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (manifold_ && !is_shared_) manifolds.push_back(manifold_);
  }
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void processCollision(const btCollisionObjectWrapper* first,
                        const btCollisionObjectWrapper* second, const btDispatcherInfo&,
                        btManifoldResult* result) override {
    const btCollisionObject* const object = first->getCollisionObject();
    if (!manifold_) manifold_ = m_dispatcher->getNewManifold(object, second->getCollisionObject());
    if (!manifold_) return;  // Bullet's pool is full and may not grow
    result->setPersistentManifold(manifold_);
    const bool is_a = first->getCollisionShape()->getShapeType() == CYLINDER_SHAPE_PROXYTYPE;
    Contact c = contact_of(
        is_a ? *first : *second, is_a ? *second : *first,
        manifold_->getContactBreakingThreshold() + result->m_closestPointDistanceThreshold);
    reduce_points(c, MANIFOLD_CACHE_SIZE);
    if ((manifold_->getBody0() == object) != is_a) c.normal = -c.normal;
    add_points(c, *result);
    if (!is_shared_) result->refreshContactPoints();
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
    const int flags = body0.getCollisionFlags() | body1.getCollisionFlags();
    const bool is_ours = !is_shared_ && !(flags & btCollisionObject::CF_HAS_FRICTION_ANCHOR);
    if (is_ours) hand_over(*manifold_, points, count);
    const btScalar breaking = manifold_->getContactBreakingThreshold();
    for (int i = 0; i < count; ++i) {
      // A manifold takes what is nearer than its threshold for the same point: of thin bodies, all.
      const btScalar near = btMax(points[i].m_distance1, breaking / 1000);
      if (is_ours) manifold_->setContactBreakingThreshold(btMin(near, breaking));
      result.addContactPoint(normal, points[i].m_positionWorldOnB, points[i].m_distance1);
    }
    manifold_->setContactBreakingThreshold(breaking);
  }

  btPersistentManifold* manifold_ = nullptr;
  bool is_shared_ = false;  ///< the manifold is another algorithm's
};

struct CreateAlgorithm : btCollisionAlgorithmCreateFunc {
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper*,
                                                 const btCollisionObjectWrapper*) override {
    return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Algorithm))) Algorithm(info);
  }
};

/// Registers for every pair what `create_function` names, twice: for contacts, and for closest
/// points.
template <class CreateFunction>
void register_pairs(btCollisionDispatcher& dispatcher, const CreateFunction& create_function) {
  for (const int other : {CYLINDER_SHAPE_PROXYTYPE, BOX_SHAPE_PROXYTYPE, CAPSULE_SHAPE_PROXYTYPE,
                          SPHERE_SHAPE_PROXYTYPE, STATIC_PLANE_PROXYTYPE}) {
    for (const auto& [i, j] : {std::pair(int{CYLINDER_SHAPE_PROXYTYPE}, other),
                               std::pair(other, int{CYLINDER_SHAPE_PROXYTYPE})}) {
      dispatcher.registerCollisionCreateFunc(i, j, create_function(i, j, false));
      dispatcher.registerClosestPointsCreateFunc(i, j, create_function(i, j, true));
    }
  }
}

}  // namespace detail

/// Gives every pair with a cylinder to Touchstone. Pairs that overlap already keep the algorithm
/// that they have until their bounding boxes part.
inline void install(btCollisionDispatcher& dispatcher) {
  static detail::CreateAlgorithm create;
  detail::register_pairs(dispatcher, [](int, int, bool) { return &create; });
}

/// Gives them back to what the dispatcher's configuration names.
inline void uninstall(btCollisionDispatcher& dispatcher) {
  btCollisionConfiguration& own = *dispatcher.getCollisionConfiguration();
  detail::register_pairs(dispatcher, [&](int i, int j, bool is_for_closest_points) {
    return is_for_closest_points ? own.getClosestPointsAlgorithmCreateFunc(i, j)
                                 : own.getCollisionAlgorithmCreateFunc(i, j);
  });
}

}  // namespace touchstone::bullet
