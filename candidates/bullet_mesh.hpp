#pragma once

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <vector>

#include "candidates/floor.hpp"

namespace touchstone {

/// What a mesh of Bullet keeps pointers to.
struct BulletTriangles {
  explicit BulletTriangles(const Floor& floor) : triangles(floor.triangles()) {
    for (const Vec3& c : floor.corners()) {
      corners.emplace_back(static_cast<btScalar>(c.x()), static_cast<btScalar>(c.y()),
                           static_cast<btScalar>(c.z()));
    }
    all = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(triangles.size()), triangles.front().data(), sizeof(Floor::Triangle),
        static_cast<int>(corners.size()), static_cast<btScalar*>(corners.front()),
        sizeof(btVector3));
  }

  std::vector<btVector3> corners;
  std::vector<Floor::Triangle> triangles;
  std::unique_ptr<btTriangleIndexVertexArray> all;
};

/// A floor as Bullet's mesh, whose margin is 0 by default.
class BulletFloor : private BulletTriangles, public btBvhTriangleMeshShape {
 public:
  explicit BulletFloor(const Floor& floor)
      : BulletTriangles(floor), btBvhTriangleMeshShape(all.get(), true) {}
};

}  // namespace touchstone
