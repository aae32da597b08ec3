// Bullet 3.24 in double precision: floors of triangles.
//
// Calls        As bullet.cpp: the narrow phase that a world runs, here btConvexConcave-
//              CollisionAlgorithm, which asks GJK and EPA for every triangle near the cylinder and
//              keeps four points of all of them; one query with an empty manifold.
// Shapes       bullet-floor:N    btBvhTriangleMeshShape of the plane's or box's triangles
//                                (floor.hpp).
//              bullet-heights:N  btHeightfieldTerrainShape: the plane alone.
//              …-edges:N         The same with btInternalEdgeUtility, which turns normals at seams
//                                back: btGenerateInternalEdgeInfo, and btAdjustInternalEdgeContacts
//                                in gContactAddedCallback.
// Margin       As Bullet makes them: the cylinder's rounds its edges (bullet.cpp), floors have
// none. Conventions  As bullet.cpp. Traps        A floor has no inside: a cylinder wholly below its
// surface is not in contact. A
//              heightfield has its origin in the middle of its heights; its samples are one unit
//              apart, which setLocalScaling changes; with z up its triangles look down, and
//              btInternalEdgeUtility does nothing unless setFlipTriangleWinding turns them.
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btTriangleInfoMap.h>
#include <memory>
#include <vector>

#include "candidates/adapter.hpp"
#include "candidates/bullet_mesh.hpp"
#include "candidates/bullet_pair.hpp"
#include "candidates/floor.hpp"

namespace {

using touchstone::Floor, touchstone::to_scalar;

/// Where a heightfield finds its samples.
struct Heights {
  std::vector<btScalar> samples;
};

/// A plane as Bullet's heightfield.
class HeightField : private Heights, public btHeightfieldTerrainShape {
 public:
  explicit HeightField(const Floor& floor)
      : Heights{std::vector<btScalar>(floor.corners().size(), 0)},
        btHeightfieldTerrainShape(floor.count() + 1, floor.count() + 1,
                                  static_cast<const btScalar*>(samples.data()), btScalar{0},
                                  btScalar{0}, 2, false) {
    setLocalScaling(btVector3(to_scalar(floor.side()), to_scalar(floor.side()), 1));
    setFlipTriangleWinding(true);
  }
};

bool adjust_normal(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int,
                   const btCollisionObjectWrapper* second, int part, int index) {
  btAdjustInternalEdgeContacts(point, second, first, part, index);
  return true;
}

/// A shape of the floor, with the map of its edges if it is to have one.
template <class Shape>
std::unique_ptr<btCollisionShape> make_floor(const Floor& floor, btTriangleInfoMap* edges) {
  auto shape = std::make_unique<Shape>(floor);
  if (edges) btGenerateInternalEdgeInfo(shape.get(), edges);
  return shape;
}

}  // namespace

struct ts_prepared {
  Floor floor;
  std::unique_ptr<btTriangleInfoMap> edges;
  touchstone::BulletPair pair;
};

namespace {

template <class Shape, bool adjusts>
ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double count) {
  const Floor floor(*a, *b, static_cast<int>(count));
  auto edges = adjusts ? std::make_unique<btTriangleInfoMap>() : nullptr;
  const btScalar radius = to_scalar(a->size[0]);
  auto cylinder =
      std::make_unique<btCylinderShapeZ>(btVector3(radius, radius, to_scalar(a->size[1])));
  auto shape = make_floor<Shape>(floor, edges.get());
  auto* const made = new ts_prepared{
      floor, std::move(edges), {std::move(cylinder), std::move(shape), threshold, false}};
  gContactAddedCallback = adjust_normal;
  if (adjusts) made->pair.call_back();
  return made;
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
           ts_answer* answer) {
  prepared->pair.query(*a, prepared->floor.at(*a, *b), *answer);
}

using touchstone::BulletFloor;
using touchstone::adapter::release, touchstone::adapter::supports_flat,
    touchstone::adapter::supports_plane;

#define SETTINGS(rest) \
  "double precision; " rest "; default margins; one query with an empty manifold"

const ts_candidate candidates[] = {
    {"bullet-floor", TOUCHSTONE_BULLET_VERSION,
     SETTINGS("plane or box as btBvhTriangleMeshShape of N by N squares of two triangles"), nullptr,
     &touchstone::floor_parameter, supports_flat, prepare<BulletFloor, false>, query, release,
     nullptr, nullptr},
    {"bullet-floor-edges", TOUCHSTONE_BULLET_VERSION,
     SETTINGS("as bullet-floor, with btInternalEdgeUtility"), nullptr, &touchstone::floor_parameter,
     supports_flat, prepare<BulletFloor, true>, query, release, nullptr, nullptr},
    {"bullet-heights", TOUCHSTONE_BULLET_VERSION,
     SETTINGS("plane as btHeightfieldTerrainShape of N by N squares"), nullptr,
     &touchstone::floor_parameter, supports_plane, prepare<HeightField, false>, query, release,
     nullptr, nullptr},
    {"bullet-heights-edges", TOUCHSTONE_BULLET_VERSION,
     SETTINGS("as bullet-heights, with btInternalEdgeUtility"), nullptr,
     &touchstone::floor_parameter, supports_plane, prepare<HeightField, true>, query, release,
     nullptr, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
