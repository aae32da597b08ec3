// FCL 0.7.0 in double precision, on libccd 2.1: floors of triangles.
//
// Calls        fcl::collide with the default request (GST_LIBCCD: libccd's MPR of the cylinder and
//              each triangle near it), asked for a contact with every triangle; the 16 deepest are
//              kept.
// Shapes       fcl-floor:N is a BVHModel<OBBRSS> of the plane's or box's triangles (floor.hpp).
//              FCL's own heightfield is an octree of boxes, which is no floor.
// Conventions  The mesh is object 1: the normal points from it to the cylinder.
// Points       One a triangle, where MPR puts it.
// Threshold    collide has none.
// Traps        A mesh has no inside: a cylinder wholly below its surface is not in contact.
#include <cstddef>
#include <fcl/fcl.h>
#include <vector>

#include "candidates/adapter.hpp"
#include "candidates/floor.hpp"

namespace {

using touchstone::Floor;
using Mesh = fcl::BVHModel<fcl::OBBRSSd>;

void build(const Floor& floor, Mesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& [i, j, k] : floor.triangles()) {
    triangles.emplace_back(static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                           static_cast<std::size_t>(k));
  }
  mesh.beginModel();
  mesh.addSubModel(floor.corners(), triangles);
  mesh.endModel();
}

fcl::Transform3d to_transform(const ts_pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = touchstone::rotation_of(pose);
  t.translation() = touchstone::position_of(pose);
  return t;
}

}  // namespace

struct ts_prepared {
  ts_prepared(const ts_shape& a, const ts_shape& b, int count)
      : floor(a, b, count), cylinder(a.size[0], 2 * a.size[1]) {
    build(floor, mesh);
  }

  Floor floor;
  fcl::Cylinderd cylinder;
  Mesh mesh;
};

namespace {

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double, double count) {
  return new ts_prepared(*a, *b, static_cast<int>(count));
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
           ts_answer* answer) {
  const fcl::CollisionRequestd request(prepared->floor.triangles().size(), true);
  fcl::CollisionResultd result;
  fcl::collide(&prepared->mesh, to_transform(prepared->floor.at(*a, *b)), &prepared->cylinder,
               to_transform(*a), request, result);
  touchstone::adapter::begin(*answer);
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const fcl::Contactd& c = result.getContact(i);
    touchstone::adapter::add_point(c.pos, c.normal, -c.penetration_depth, *answer);
  }
}

using touchstone::adapter::release, touchstone::adapter::supports_flat;

const ts_candidate candidates[] = {
    {"fcl-floor", TOUCHSTONE_FCL_VERSION,
     "double precision; plane or box as BVHModel<OBBRSS> of N by N squares of two triangles; "
     "collide with default settings (libccd's MPR with each triangle); the 16 deepest points",
     nullptr, &touchstone::floor_parameter, supports_flat, prepare, query, release, nullptr,
     nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
