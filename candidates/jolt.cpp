// Jolt Physics as a native library, single precision (npm/jolt.mjs asks its WebAssembly build).
//
// Calls        CollisionDispatch::sCollideShapeVsShape of the cylinder (shape 1) and the other body
//              (shape 2), with the settings of a default CollideShapeSettings and faces collected;
//              then ManifoldBetweenTwoFaces and PruneContactPoints, as PhysicsSystem does with its
//              default settings: up to four points.
// Shapes       CylinderShape and CapsuleShape along y, turned to ours; SphereShape, BoxShape,
//              PlaneShape.
// Margin       jolt-native: Jolt's convex radius of 0.05 m on cylinder and box, at most half of the
//              smallest half extent. It is taken from the inside: faces stay where they are, edges
//              are rounded. jolt-native-margin-0: convex radius 0.
// Conventions  mPenetrationAxis moves shape 2 out: minus its direction is our normal.
// Points       Midway between those on both bodies, which lie on the two faces; those of negative
//              depth beyond the threshold are dropped, the deepest one never is.
// Threshold    mMaxSeparationDistance, and the distance within which faces give points, at least
//              Jolt's own speculative one of 2 cm and manifold tolerance of 1 mm.
// Precision    Poses are rounded to float, and are taken relative to body A.
// Version      Of the installed package; not in Debian 12. Built where CMake finds Jolt's package.
// clang-format off
#include <Jolt/Jolt.h>  // before all others of Jolt
// clang-format on

#include <Jolt/Core/Factory.h>
#include <Jolt/Physics/Collision/CollideShape.h>
#include <Jolt/Physics/Collision/CollisionCollectorImpl.h>
#include <Jolt/Physics/Collision/CollisionDispatch.h>
#include <Jolt/Physics/Collision/ManifoldBetweenTwoFaces.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/CylinderShape.h>
#include <Jolt/Physics/Collision/Shape/PlaneShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/PhysicsSettings.h>
#include <Jolt/RegisterTypes.h>
#include <algorithm>
#include <string>

#include "candidates/adapter.hpp"

namespace {

using JPH::Mat44, JPH::Quat, JPH::Shape, JPH::Vec3;

float to_float(double x) { return static_cast<float>(x); }

JPH::Ref<Shape> make_shape(const ts_shape& shape, double max_radius) {
  const double* s = shape.size;
  const auto radius = [&](double smallest) { return to_float(std::min(max_radius, smallest / 2)); };
  switch (shape.kind) {
    case TS_CYLINDER:
      return new JPH::CylinderShape(to_float(s[1]), to_float(s[0]), radius(std::min(s[0], s[1])));
    case TS_PLANE:
      return new JPH::PlaneShape(
          JPH::Plane(Vec3(to_float(s[0]), to_float(s[1]), to_float(s[2])), -to_float(s[3])));
    case TS_SPHERE:
      return new JPH::SphereShape(to_float(s[0]));
    case TS_CAPSULE:
      return new JPH::CapsuleShape(to_float(s[1]), to_float(s[0]));
    case TS_BOX:
      return new JPH::BoxShape(Vec3(to_float(s[0]), to_float(s[1]), to_float(s[2])),
                               radius(std::min({s[0], s[1], s[2]})));
    case TS_CONVEX:
      break;  // not supported
  }
  return nullptr;
}

/// The pose about `origin`, for a shape along y if ours is along z.
Mat44 to_transform(const ts_pose& p, const double (&origin)[3], bool along_y) {
  const double* q = p.orientation;
  Quat turned(to_float(q[1]), to_float(q[2]), to_float(q[3]), to_float(q[0]));
  if (along_y) turned = turned * Quat::sRotation(Vec3::sAxisX(), 0.5F * JPH::JPH_PI);
  return Mat44::sRotationTranslation(
      turned.Normalized(),
      Vec3(to_float(p.position[0] - origin[0]), to_float(p.position[1] - origin[1]),
           to_float(p.position[2] - origin[2])));
}

}  // namespace

struct ts_prepared {
  JPH::Ref<Shape> a, b;
  JPH::CollideShapeSettings settings;
  bool b_along_y;
};

namespace {

template <bool rounded>
ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double) {
  const double max_radius = rounded ? double{JPH::cDefaultConvexRadius} : 0;
  auto* const p = new ts_prepared{make_shape(*a, max_radius),
                                  make_shape(*b, max_radius),
                                  {},
                                  b->kind == TS_CYLINDER || b->kind == TS_CAPSULE};
  p->settings.mMaxSeparationDistance = to_float(threshold);
  p->settings.mCollectFacesMode = JPH::ECollectFacesMode::CollectFaces;
  return p;
}

void add(const Vec3& on_a, const Vec3& on_b, double depth, const double (&origin)[3],
         ts_answer& answer) {
  ts_point& point = answer.points[answer.point_count++];
  const Vec3 middle = 0.5F * (on_a + on_b);
  for (unsigned i = 0; i < 3; ++i) point.position[i] = origin[i] + double{middle[i]};
  std::copy(std::begin(answer.normal), std::end(answer.normal), point.normal);
  point.depth = depth;
}

void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double*, ts_answer* answer) {
  touchstone::adapter::begin(*answer);
  const double(&origin)[3] = a->position;
  JPH::ClosestHitCollisionCollector<JPH::CollideShapeCollector> closest;
  const Vec3 one = Vec3::sReplicate(1);
  JPH::CollisionDispatch::sCollideShapeVsShape(
      p->a, p->b, one, one, to_transform(*a, origin, true), to_transform(*b, origin, p->b_along_y),
      JPH::SubShapeIDCreator(), JPH::SubShapeIDCreator(), p->settings, closest);
  if (!closest.HadHit()) return;
  const JPH::CollideShapeResult& hit = closest.mHit;
  const Vec3 axis = hit.mPenetrationAxis.Normalized();
  answer->status = TS_CONTACT;
  answer->signed_distance = -double{hit.mPenetrationDepth};
  for (unsigned i = 0; i < 3; ++i) answer->normal[i] = -double{axis[i]};

  const JPH::PhysicsSettings physics;
  const float distance =
      std::max(p->settings.mMaxSeparationDistance, physics.mSpeculativeContactDistance) +
      physics.mManifoldTolerance;
  JPH::ContactPoints on_a, on_b;
  JPH::ManifoldBetweenTwoFaces(hit.mContactPointOn1, hit.mContactPointOn2, hit.mPenetrationAxis,
                               distance, hit.mShape1Face, hit.mShape2Face, on_a,
                               on_b JPH_IF_DEBUG_RENDERER(, JPH::RVec3::sZero()));
  if (on_a.size() > 4) {
    JPH::PruneContactPoints(axis, on_a, on_b JPH_IF_DEBUG_RENDERER(, JPH::RVec3::sZero()));
  }
  for (JPH::uint i = 0; i < on_a.size(); ++i) {
    const double depth = double{(on_a[i] - on_b[i]).Dot(axis)};
    if (-depth <= double{p->settings.mMaxSeparationDistance}) {
      add(on_a[i], on_b[i], depth, origin, *answer);
    }
  }
  if (answer->point_count == 0) {
    add(hit.mContactPointOn1, hit.mContactPointOn2, double{hit.mPenetrationDepth}, origin, *answer);
  }
}

using touchstone::adapter::release, touchstone::adapter::supports_primitives;

const std::string version = std::to_string(JPH_VERSION_MAJOR) + '.' +
                            std::to_string(JPH_VERSION_MINOR) + '.' +
                            std::to_string(JPH_VERSION_PATCH);
const ts_candidate candidates[] = {
    {"jolt-native", version.c_str(),
     "single precision; sCollideShapeVsShape and the manifold of a world; convex radius 0.05 m, at "
     "most half of the smallest half extent",
     nullptr, nullptr, supports_primitives, prepare<true>, query, release, nullptr, nullptr},
    {"jolt-native-margin-0", version.c_str(),
     "single precision; sCollideShapeVsShape and the manifold of a world; convex radius 0", nullptr,
     nullptr, supports_primitives, prepare<false>, query, release, nullptr, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() {
  // Until the types are registered, every pair's function is null.
  JPH::RegisterDefaultAllocator();
  JPH::Factory::sInstance = new JPH::Factory;
  JPH::RegisterTypes();
  return &plugin;
}
