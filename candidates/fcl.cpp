// FCL 0.7.0 in double precision, on libccd 2.1.
//
// Calls        fcl          fcl::collide with the default request (GST_LIBCCD: libccd's MPR where
// FCL
//                           has no routine of its own), asked for 16 contacts.
//              fcl-indep    fcl::collide with GST_INDEP, FCL's own GJK and EPA.
//              fcl-distance fcl::distance with enable_signed_distance (GST_LIBCCD: FCL's GJK
//                           and EPA over libccd), with default tolerances.
// Routes       Half-space and sphere are FCL's own closed forms in collide.
// Shapes       Cylinder and Capsule by full length, the capsule's without its caps; Box by full
//              lengths; a plane is a Halfspace, solid where n·x <= d; a convex body is a Convex of
//              its vertices and faces, be it flat or not.
// Conventions  collide's normal points from object 1 to object 2 and is reversed. fcl::distance
//              gives no normal; it is taken along the line between the two nearest points, each
//              on its own body. At exact touch there is no line, and it stays zero.
// Corrected    With GST_INDEP, pairs without a closed form come with a negative depth and a normal
//              in object 1's local frame (gjk_solver_indep-inl.h, ShapeIntersectIndepImpl): both
//              are corrected here, so that the solver is judged and not this slip.
// Points       collide: one at mid-depth, or inside both bodies where MPR answers. distance: the
//              middle of the two nearest points.
// Threshold    collide has none. distance reports up to it.
// Casts        fcl::continuousCollide of a translation: fcl with the default request, which tries
// ten
//              poses on the way (CCDC_NAIVE); fcl-distance by conservative advancement. Neither
//              says a normal. A touch is reported up to 1e-4 of the sweep late.
// Asserts      are active in Debian's libfcl: a failed one ends the process and counts as a crash.
#include <cstddef>
#include <fcl/fcl.h>
#include <memory>
#include <vector>

#include "candidates/adapter.hpp"
#include "candidates/cast.h"

namespace {

using touchstone::adapter::add_point;
using Vector = fcl::Vector3d;
using Transform = fcl::Transform3d;
using Geometry = std::unique_ptr<fcl::CollisionGeometryd>;

Geometry make_convex(const ts_shape& shape) {
  auto vertices = std::make_shared<std::vector<Vector>>();
  for (int i = 0; i < shape.vertex_count; ++i) {
    vertices->emplace_back(Eigen::Map<const Vector>(shape.vertices + std::ptrdiff_t{3} * i));
  }
  const auto list = touchstone::face_list_of(shape);
  return std::make_unique<fcl::Convexd>(
      vertices, shape.face_count, std::make_shared<std::vector<int>>(list.begin(), list.end()));
}

Geometry make_geometry(const ts_shape& shape) {
  const double* s = shape.size;
  switch (shape.kind) {
    case TS_CYLINDER:
      return std::make_unique<fcl::Cylinderd>(s[0], 2 * s[1]);
    case TS_PLANE:
      return std::make_unique<fcl::Halfspaced>(Vector(s[0], s[1], s[2]), s[3]);
    case TS_SPHERE:
      return std::make_unique<fcl::Sphered>(s[0]);
    case TS_CAPSULE:
      return std::make_unique<fcl::Capsuled>(s[0], 2 * s[1]);
    case TS_BOX:
      return std::make_unique<fcl::Boxd>(2 * s[0], 2 * s[1], 2 * s[2]);
    case TS_CONVEX:
      return make_convex(shape);
  }
  return nullptr;
}

Transform to_transform(const ts_pose& p) {
  Transform t = Transform::Identity();
  const double* q = p.orientation;
  t.linear() = fcl::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  t.translation() = Vector(p.position[0], p.position[1], p.position[2]);
  return t;
}

}  // namespace

struct ts_prepared {
  Geometry a, b;
  double threshold;
  bool own_routine;  ///< FCL has a closed form for the pair
};

namespace {

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double) {
  return new ts_prepared{make_geometry(*a), make_geometry(*b), threshold,
                         b->kind == TS_PLANE || b->kind == TS_SPHERE};
}

template <fcl::GJKSolverType solver>
void collide(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
             ts_answer* answer) {
  fcl::CollisionRequestd request(TOUCHSTONE_MAX_POINTS, true);
  request.gjk_solver_type = solver;
  fcl::CollisionResultd result;
  const Transform at_a = to_transform(*a);
  fcl::collide(prepared->a.get(), at_a, prepared->b.get(), to_transform(*b), request, result);
  touchstone::adapter::begin(*answer);
  const bool wrong_frame = solver == fcl::GST_INDEP && !prepared->own_routine;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const fcl::Contactd& c = result.getContact(i);
    if (wrong_frame) {
      add_point(c.pos, Vector(-(at_a.linear() * c.normal)), c.penetration_depth, *answer);
    } else {
      add_point(c.pos, Vector(-c.normal), -c.penetration_depth, *answer);
    }
  }
}

void distance(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
              ts_answer* answer) {
  const fcl::DistanceRequestd request(true, true);
  fcl::DistanceResultd result;
  const double d = fcl::distance(prepared->a.get(), to_transform(*a), prepared->b.get(),
                                 to_transform(*b), request, result);
  touchstone::adapter::begin(*answer);
  const Vector& on_a = result.nearest_points[0];
  const Vector& on_b = result.nearest_points[1];
  const Vector line = d < 0 ? Vector(on_b - on_a) : Vector(on_a - on_b);
  const double length = line.norm();
  const Vector normal = length == 0 ? Vector(Vector::Zero()) : Vector(line / length);
  add_point(Vector((on_a + on_b) / 2), normal, d, *answer);
  if (d > prepared->threshold) answer->status = TS_NONE;  // NaN is reported, not dropped
}

using touchstone::adapter::release, touchstone::adapter::supports_all,
    touchstone::adapter::supports_bounded;

const ts_candidate candidates[] = {
    {"fcl", TOUCHSTONE_FCL_VERSION,
     "double precision; collide with default settings (GST_LIBCCD: libccd's MPR; half-space and "
     "sphere analytic), asked for 16 contacts",
     nullptr, nullptr, supports_all, prepare, collide<fcl::GST_LIBCCD>, release, nullptr, nullptr},
    {"fcl-indep", TOUCHSTONE_FCL_VERSION,
     "double precision; collide with GST_INDEP (FCL's own GJK and EPA; half-space and sphere "
     "analytic); its negative depths and local normals are put right",
     nullptr, nullptr, supports_all, prepare, collide<fcl::GST_INDEP>, release, nullptr, nullptr},
    {"fcl-distance", TOUCHSTONE_FCL_VERSION,
     "double precision; distance with enable_signed_distance, default tolerances (GJK and EPA); "
     "normal along the two nearest points; no half-space",
     nullptr, nullptr, supports_bounded, prepare, distance, release, nullptr, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }

void touchstone_cast(int candidate, const ts_shape* a, const ts_shape* b, const ts_pose* pose_a,
                     const ts_pose* pose_b, const double sweep[3], ts_cast* answer) {
  constexpr int by_solver = 1, by_distance = 2;  // of the candidates
  answer->status = TS_CAST_UNSUPPORTED;
  if (candidate == by_solver) return;
  const Geometry geometry_a = make_geometry(*a), geometry_b = make_geometry(*b);
  const Transform from = to_transform(*pose_a), at_b = to_transform(*pose_b);
  Transform to = from;
  to.translation() += Vector(sweep[0], sweep[1], sweep[2]);
  fcl::ContinuousCollisionRequestd request;
  if (candidate == by_distance) request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(geometry_a.get(), from, to, geometry_b.get(), at_b, at_b, request, result);
  answer->status = result.is_collide ? TS_CAST_TOUCH : TS_CAST_NEVER;
  answer->fraction = result.time_of_contact;
}
