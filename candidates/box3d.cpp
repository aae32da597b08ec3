// Box3D (erincatto/box3d), single precision.
//
// Calls        The pair's function of collision.h, with an empty cache: b3CollideHulls,
//              b3CollideHullAndSphere or b3CollideHullAndCapsule, as a world's narrow phase does.
//              It has no half-space.
// Shapes       Box3D has no cylinder: b3CreateCylinder makes a prism of up to 32 sides with its
//              corners on the rims, along y, which is turned to z. box3d has 16 sides, box3d:N as
//              many as it is given.
// Conventions  The manifold is in frame A; its normal points from A to B and is reversed.
// Points       As Box3D places them: on the reference face's side, or midway for edges.
// Threshold    Box3D answers contacts up to its speculative distance of 2 cm apart; what lies
// beyond
//              the threshold is dropped. Beyond 2 cm it has no answer.
// Precision    Poses are rounded to float, and are taken relative to body A.
// Version      Of the installed package; not in Debian 12. Built where CMake finds Box3D's package.
#include <box3d/collision.h>
#include <box3d/math_functions.h>
#include <cmath>
#include <string>

#include "candidates/adapter.hpp"

namespace {

float to_float(double x) { return static_cast<float>(x); }

b3Quat to_quat(const double (&q)[4]) {
  return {{to_float(q[1]), to_float(q[2]), to_float(q[3])}, to_float(q[0])};
}

/// A prism along z about its centre.
b3HullData* make_prism(const ts_shape& shape, int sides) {
  const float height = to_float(2 * shape.size[1]);
  b3HullData* const along_y = b3CreateCylinder(height, to_float(shape.size[0]), -height / 2, sides);
  const float half = std::sqrt(0.5F);
  b3HullData* const result =
      b3CloneAndTransformHull(along_y, {{0, 0, 0}, {{half, 0, 0}, half}}, {1, 1, 1});
  b3DestroyHull(along_y);
  return result;
}

}  // namespace

struct ts_prepared {
  ts_shape_kind kind;  ///< of B
  double threshold;
  b3HullData* a;
  b3HullData* prism;  ///< B as a cylinder; else null
  b3BoxHull box;
  b3Sphere sphere;
  b3Capsule capsule;

  const b3HullData* hull() const { return prism ? prism : &box.base; }
};

namespace {

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double sides) {
  auto* const p = new ts_prepared{};
  p->kind = b->kind;
  p->threshold = threshold;
  p->a = make_prism(*a, static_cast<int>(sides));
  const float radius = to_float(b->size[0]), half_length = to_float(b->size[1]);
  if (b->kind == TS_CYLINDER) p->prism = make_prism(*b, static_cast<int>(sides));
  if (b->kind == TS_BOX) p->box = b3MakeBoxHull(radius, half_length, to_float(b->size[2]));
  if (b->kind == TS_SPHERE) p->sphere = {{0, 0, 0}, radius};
  if (b->kind == TS_CAPSULE) p->capsule = {{0, 0, -half_length}, {0, 0, half_length}, radius};
  return p;
}

void release(ts_prepared* p) {
  b3DestroyHull(p->a);
  if (p->prism) b3DestroyHull(p->prism);
  delete p;
}

void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double*, ts_answer* answer) {
  const b3Quat turn_a = to_quat(a->orientation);
  const b3Vec3 apart = {to_float(b->position[0] - a->position[0]),
                        to_float(b->position[1] - a->position[1]),
                        to_float(b->position[2] - a->position[2])};
  const b3Transform b_in_a = {b3InvRotateVector(turn_a, apart),
                              b3InvMulQuat(turn_a, to_quat(b->orientation))};
  b3LocalManifoldPoint points[TOUCHSTONE_MAX_POINTS];
  b3LocalManifold manifold{};
  manifold.points = points;
  b3SATCache axes{};
  b3SimplexCache simplex{};
  if (p->kind == TS_SPHERE) {
    b3CollideHullAndSphere(&manifold, TOUCHSTONE_MAX_POINTS, p->a, &p->sphere, b_in_a, &simplex);
  } else if (p->kind == TS_CAPSULE) {
    b3CollideHullAndCapsule(&manifold, TOUCHSTONE_MAX_POINTS, p->a, &p->capsule, b_in_a, &simplex);
  } else {
    b3CollideHulls(&manifold, TOUCHSTONE_MAX_POINTS, p->a, p->hull(), b_in_a, &axes);
  }
  const b3Vec3 n = b3Neg(b3RotateVector(turn_a, manifold.normal));
  const float normal[3] = {n.x, n.y, n.z};
  touchstone::adapter::begin(*answer);
  for (int i = 0; i < manifold.pointCount; ++i) {
    const double separation = double{points[i].separation};
    if (separation > p->threshold) continue;
    const b3Vec3 at = b3RotateVector(turn_a, points[i].point);
    const double position[3] = {a->position[0] + double{at.x}, a->position[1] + double{at.y},
                                a->position[2] + double{at.z}};
    touchstone::adapter::add_point(position, normal, separation, *answer);
  }
}

int supports(void*, ts_shape_kind other) { return other != TS_PLANE && other != TS_CONVEX; }

const ts_parameter sides = {"number of sides", 3, 32, 16, 1, 1};
const std::string version = [] {
  const b3Version v = b3GetVersion();
  return std::to_string(v.major) + '.' + std::to_string(v.minor) + '.' + std::to_string(v.revision);
}();
const ts_candidate candidates[] = {
    {"box3d", version.c_str(),
     "single precision; the pair's function with an empty cache; its own prism for every cylinder",
     "every cylinder as the regular prism with its corners on the rims", &sides, supports, prepare,
     query, release, nullptr, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
