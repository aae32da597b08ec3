// libccd 2.1 by itself, in double precision.
//
// Calls        libccd-gjk: ccdGJKPenetration (GJK, then EPA). libccd-mpr: ccdMPRPenetration.
// Shapes       Exact support functions, as in libccd's own test suite; a half-space has none and is
//              not supported. A convex body's is its vertex furthest along, and its centre, from
//              which MPR searches, the mean of its vertices.
// Tolerance    The parameter is epa_tolerance or mpr_tolerance; libccd's default is 1e-4, in metres
//              for EPA. At most 100 iterations, as in libccd's README: without a bound EPA can
//              hang.
// Conventions  `dir` points from A to B, the way B moves to come free, and is reversed. If they
//              exactly touch, MPR's is zero and is passed on as it is.
// Points       One: MPR's lies inside both bodies; EPA's position is, according to libccd, not a
//              contact point, only somewhere between.
// Threshold    libccd has none: it answers only if it finds the bodies touching.
// Failure      -2, out of memory, is passed on as failed.
#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <cmath>
#include <cstddef>
#include <limits>

#include "candidates/adapter.hpp"

static_assert(sizeof(ccd_real_t) == sizeof(double), "built against single-precision libccd");

namespace {

struct Body {
  explicit Body(const ts_shape& of) : shape(of) {
    if (of.kind != TS_CONVEX) return;
    const auto middle = touchstone::adapter::middle_of(of);
    ccdVec3Set(&centre, middle[0], middle[1], middle[2]);
  }

  touchstone::OwnedShape shape;
  ccd_vec3_t centre{};  ///< local
  ccd_vec3_t position;
  ccd_quat_t orientation, inverse;  // local to world, world to local

  void place(const ts_pose& pose) {
    const double *p = pose.position, *q = pose.orientation;
    ccdVec3Set(&position, p[0], p[1], p[2]);
    ccdQuatSet(&orientation, q[1], q[2], q[3], q[0]);
    ccdQuatInvert2(&inverse, &orientation);
  }
};

double side(double direction, double extent) { return direction < 0 ? -extent : extent; }

void support_of_hull(const ts_shape& hull, const ccd_vec3_t& d, ccd_vec3_t& p) {
  double furthest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < hull.vertex_count; ++i) {
    ccd_vec3_t vertex;
    const double* const v = hull.vertices + std::ptrdiff_t{3} * i;
    ccdVec3Set(&vertex, v[0], v[1], v[2]);
    const double along = ccdVec3Dot(&d, &vertex);
    if (along <= furthest) continue;
    furthest = along;
    p = vertex;
  }
}

/// The shape's point furthest along d, in its own frame.
void support_locally(const ts_shape& shape, const ccd_vec3_t& d, ccd_vec3_t& p) {
  const double *s = shape.size, *v = d.v;
  switch (shape.kind) {
    case TS_CYLINDER: {
      const double across = std::hypot(v[0], v[1]);
      const double scale = across > 0 ? s[0] / across : 0;
      ccdVec3Set(&p, scale * v[0], scale * v[1], side(v[2], s[1]));
      return;
    }
    case TS_SPHERE:
    case TS_CAPSULE: {
      const double length = std::sqrt(ccdVec3Len2(&d));
      const double scale = length > 0 ? s[0] / length : 0;
      const double end = shape.kind == TS_CAPSULE ? side(v[2], s[1]) : 0;
      ccdVec3Set(&p, scale * v[0], scale * v[1], scale * v[2] + end);
      return;
    }
    case TS_BOX:
      ccdVec3Set(&p, side(v[0], s[0]), side(v[1], s[1]), side(v[2], s[2]));
      return;
    case TS_CONVEX:
      support_of_hull(shape, d, p);
      return;
    case TS_PLANE:
      return;
  }
}

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Body& body = *static_cast<const Body*>(object);
  ccd_vec3_t d = *direction;
  ccdQuatRotVec(&d, &body.inverse);
  support_locally(body.shape.get(), d, *point);
  ccdQuatRotVec(point, &body.orientation);
  ccdVec3Add(point, &body.position);
}

void centre(const void* object, ccd_vec3_t* point) {
  const Body& body = *static_cast<const Body*>(object);
  *point = body.centre;
  ccdQuatRotVec(point, &body.orientation);
  ccdVec3Add(point, &body.position);
}

}  // namespace

struct ts_prepared {
  Body a, b;
  ccd_t ccd;
};

namespace {

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double, double tolerance) {
  auto* const p = new ts_prepared{Body(*a), Body(*b), {}};
  CCD_INIT(&p->ccd);
  p->ccd.support1 = p->ccd.support2 = support;
  p->ccd.center1 = p->ccd.center2 = centre;
  p->ccd.max_iterations = 100;
  p->ccd.epa_tolerance = p->ccd.mpr_tolerance = tolerance;
  return p;
}

using Penetration = decltype(ccdGJKPenetration);

template <Penetration* penetration>
void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double*, ts_answer* answer) {
  p->a.place(*a);
  p->b.place(*b);
  double depth = 0;
  ccd_vec3_t direction, position;
  const int result = penetration(&p->a, &p->b, &p->ccd, &depth, &direction, &position);
  touchstone::adapter::begin(*answer);
  if (result == -2) answer->status = TS_FAILED;
  if (result != 0) return;
  ccdVec3Scale(&direction, -1);
  touchstone::adapter::add_point(position.v, direction.v, -depth, *answer);
}

using touchstone::adapter::release, touchstone::adapter::supports_bounded;

const ts_parameter tolerance = {"tolerance", 1e-16, 1, 1e-4, 0, 1};

const ts_candidate candidates[] = {
    {"libccd-gjk", TOUCHSTONE_CCD_VERSION,
     "double precision; ccdGJKPenetration (GJK and EPA), epa_tolerance 1e-4 by default, at most "
     "100 iterations; no plane",
     nullptr, &tolerance, supports_bounded, prepare, query<ccdGJKPenetration>, release, nullptr,
     nullptr},
    {"libccd-mpr", TOUCHSTONE_CCD_VERSION,
     "double precision; ccdMPRPenetration, mpr_tolerance 1e-4 by default, at most 100 iterations; "
     "no plane",
     nullptr, &tolerance, supports_bounded, prepare, query<ccdMPRPenetration>, release, nullptr,
     nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
