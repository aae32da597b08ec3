// ODE 0.16.2, double precision: floors of triangles.
//
// Calls        dCollide of the cylinder and the floor without spaces, asked for 256 contacts, of
//              which the 16 deepest are kept: there are some on every triangle.
// Routes       Against a mesh ODE clips the cylinder's cap or side with every triangle near it,
//              about separating axes of the two (collision_cylinder_trimesh.cpp); against a
//              heightfield it asks for contacts with the plane of each triangle, and keeps those
//              above it (heightfield.cpp).
// Shapes       ode-floor:N    dCreateTriMesh of the plane's or box's triangles (floor.hpp).
//              ode-heights:N  dCreateHeightfield, not wrapped: the plane alone.
// Conventions  As ode.cpp: the normal points into the first geom.
// Traps        A heightfield's heights are along y, and it lies about its geom's origin, turned
//              here. Its thickness is the floor's width: what is below that is not in contact. A
//              mesh has no inside at all.
// Threshold    ODE has none: it answers only if it finds the bodies touching.
#include <algorithm>
#include <cmath>
#include <memory>
#include <ode/ode.h>
#include <span>
#include <vector>

#include "candidates/adapter.hpp"
#include "candidates/floor.hpp"
#include "candidates/ode_library.hpp"
#include "candidates/ode_mesh.hpp"

namespace {

using touchstone::Floor;

/// A plane as ODE's heightfield.
class Heights {
 public:
  explicit Heights(const Floor& floor) : data_(dGeomHeightfieldDataCreate()) {
    const std::vector<double> flat(floor.corners().size(), 0);
    const double width = floor.count() * floor.side();
    const int samples = floor.count() + 1;
    dGeomHeightfieldDataBuildDouble(data_, flat.data(), 1, width, width, samples, samples, 1, 0,
                                    width, 0);
  }
  ~Heights() { dGeomHeightfieldDataDestroy(data_); }
  Heights(const Heights&) = delete;
  Heights& operator=(const Heights&) = delete;

  dGeomID make_geom() const { return dCreateHeightfield(nullptr, data_, 1); }

 private:
  dHeightfieldDataID data_;
};

void place(dGeomID geom, const ts_pose& pose) {
  dGeomSetPosition(geom, pose.position[0], pose.position[1], pose.position[2]);
  dGeomSetQuaternion(geom, pose.orientation);
}

}  // namespace

struct ts_prepared {
 public:
  ts_prepared(const ts_shape& a, const ts_shape& b, int count, bool has_heights)
      : floor_(a, b, count), a_(dCreateCylinder(nullptr, a.size[0], 2 * a.size[1])) {
    if (has_heights) {
      heights_ = std::make_unique<Heights>(floor_);
      b_ = heights_->make_geom();
    } else {
      mesh_ = touchstone::ode_floor(floor_);
      b_ = mesh_->make_geom(nullptr);
    }
  }
  ~ts_prepared() {
    dGeomDestroy(a_);
    dGeomDestroy(b_);
  }
  ts_prepared(const ts_prepared&) = delete;
  ts_prepared& operator=(const ts_prepared&) = delete;

  void query(const ts_pose& a, const ts_pose& b, ts_answer& answer) const {
    place(a_, a);
    ts_pose at = floor_.at(a, b);
    if (heights_) turn_up(at);
    place(b_, at);
    constexpr int max_contacts = 256;
    dContactGeom contacts[max_contacts];
    const int count = dCollide(a_, b_, max_contacts, contacts, sizeof(dContactGeom));
    touchstone::adapter::begin(answer);
    for (const dContactGeom& c : std::span(contacts, static_cast<std::size_t>(count))) {
      touchstone::adapter::add_point(c.pos, c.normal, -c.depth, answer);
    }
  }

 private:
  /// Turns the frame's y to where its z was.
  static void turn_up(ts_pose& pose) {
    dQuaternion quarter, turned;
    dQFromAxisAndAngle(quarter, 1, 0, 0, M_PI / 2);
    dQMultiply0(turned, pose.orientation, quarter);
    std::copy_n(turned, 4, pose.orientation);
  }

  Floor floor_;
  std::unique_ptr<touchstone::OdeMesh> mesh_;  ///< one of these two
  std::unique_ptr<Heights> heights_;
  dGeomID a_, b_;
};

namespace {

template <bool has_heights>
ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double, double count) {
  touchstone::initialise_ode();
  return new ts_prepared(*a, *b, static_cast<int>(count), has_heights);
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
           ts_answer* answer) {
  prepared->query(*a, *b, *answer);
}

using touchstone::adapter::release, touchstone::adapter::supports_flat,
    touchstone::adapter::supports_plane;

const ts_candidate candidates[] = {
    {"ode-floor", TOUCHSTONE_ODE_VERSION,
     "double precision; plane or box as dCreateTriMesh of N by N squares of two triangles; "
     "dCollide "
     "asked for 256 contacts, of which the 16 deepest are kept",
     nullptr, &touchstone::floor_parameter, supports_flat, prepare<false>, query, release, nullptr,
     nullptr},
    {"ode-heights", TOUCHSTONE_ODE_VERSION,
     "double precision; plane as dCreateHeightfield of N by N squares; dCollide asked for 256 "
     "contacts, of which the 16 deepest are kept",
     nullptr, &touchstone::floor_parameter, supports_plane, prepare<true>, query, release, nullptr,
     nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
