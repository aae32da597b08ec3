// ODE 0.16.2, double precision.
//
// Calls        dCollide on two geoms without spaces, asked for TOUCHSTONE_MAX_POINTS contacts.
// Routes       As Debian builds it: sphere and plane are ODE's own closed forms, the box its
//              separating-axis code with clipping, the capsule libccd's MPR, the cylinder special
//              code for nearly parallel axes and otherwise libccd's MPR.
// Shapes       Full lengths; a capsule's length is without its caps; a plane is a·x = d.
// Conventions  The normal points into the first geom, hence from B to A for a call with A first;
//              depth is positive inside. Positions are where ODE puts them (on the cylinder for a
//              plane, inside both bodies for MPR).
// Threshold    ODE has none: it answers only when it finds the bodies touching.
// Planes       A plane geom cannot be placed, so a posed plane is turned into world coordinates at
//              every query.
#include <algorithm>
#include <cmath>
#include <ode/ode.h>

#include "candidates/candidate.h"

static_assert(sizeof(dReal) == sizeof(double), "built against single-precision ODE");

namespace {

/// ODE's default handlers print and, for errors of its own, end the process.
void ignore_message(int, const char*, va_list) {}

void initialise() {
  static const bool done = [] {
    dInitODE2(0);
    dSetMessageHandler(ignore_message);
    dAllocateODEDataForThread(dAllocateMaskAll);
    return true;
  }();
  (void)done;
}

dGeomID make_geom(const ts_shape& shape) {
  const double* s = shape.size;
  switch (shape.kind) {
    case TS_CYLINDER:
      return dCreateCylinder(nullptr, s[0], 2 * s[1]);
    case TS_PLANE:
      return dCreatePlane(nullptr, s[0], s[1], s[2], s[3]);
    case TS_SPHERE:
      return dCreateSphere(nullptr, s[0]);
    case TS_CAPSULE:
      return dCreateCapsule(nullptr, s[0], 2 * s[1]);
    case TS_BOX:
      return dCreateBox(nullptr, 2 * s[0], 2 * s[1], 2 * s[2]);
  }
  return nullptr;
}

class Pair {
 public:
  Pair(const ts_shape& a, const ts_shape& b) : shape_b_(b), a_(make_geom(a)), b_(make_geom(b)) {}
  ~Pair() {
    dGeomDestroy(a_);
    dGeomDestroy(b_);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  void query(const ts_pose& a, const ts_pose& b, ts_answer& answer) {
    place(a_, a);
    if (shape_b_.kind == TS_PLANE) {
      place_plane(b);
    } else {
      place(b_, b);
    }
    dContactGeom contacts[TOUCHSTONE_MAX_POINTS];
    answer.point_count = dCollide(a_, b_, TOUCHSTONE_MAX_POINTS, contacts, sizeof(dContactGeom));
    answer.status = answer.point_count > 0 ? TS_CONTACT : TS_NONE;
    for (int i = 0; i < answer.point_count; ++i) {
      ts_point& out = answer.points[i];
      std::copy(contacts[i].pos, contacts[i].pos + 3, out.position);
      std::copy(contacts[i].normal, contacts[i].normal + 3, out.normal);
      out.depth = contacts[i].depth;
      if (i == 0 || -out.depth < answer.signed_distance) {
        answer.signed_distance = -out.depth;
        std::copy(out.normal, out.normal + 3, answer.normal);
      }
    }
  }

 private:
  static void place(dGeomID geom, const ts_pose& pose) {
    dGeomSetPosition(geom, pose.position[0], pose.position[1], pose.position[2]);
    dGeomSetQuaternion(geom, pose.orientation);
  }

  void place_plane(const ts_pose& pose) {
    dMatrix3 r;
    dRfromQ(r, pose.orientation);
    dVector3 n;
    dMultiply0_331(n, r, shape_b_.size);
    const double* p = pose.position;
    dGeomPlaneSetParams(b_, n[0], n[1], n[2],
                        shape_b_.size[3] + n[0] * p[0] + n[1] * p[1] + n[2] * p[2]);
  }

  ts_shape shape_b_;
  dGeomID a_, b_;
};

int supports(ts_shape_kind) { return 1; }

ts_prepared* prepare(const ts_shape* a, const ts_shape* b, double, double) {
  initialise();
  return reinterpret_cast<ts_prepared*>(new Pair(*a, *b));
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, ts_answer* answer) {
  reinterpret_cast<Pair*>(prepared)->query(*a, *b, *answer);
}

void release(ts_prepared* prepared) { delete reinterpret_cast<Pair*>(prepared); }

const ts_candidate candidates[] = {
    {"ode", TOUCHSTONE_ODE_VERSION,
     "double precision; dCollide asked for 16 contacts; cylinder and capsule through libccd's MPR, "
     "box by separating axes and clipping, plane and sphere analytic; positions as ODE gives them",
     nullptr, nullptr, supports, prepare, query, release, nullptr}};
const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 1, candidates};

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
