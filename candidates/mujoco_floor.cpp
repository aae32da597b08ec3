// MuJoCo 2.2.2, double precision: floors of triangles.
//
// Calls        The collision function of height field and cylinder in mjCOLLISIONFUNC, which asks
//              libccd's MPR for every prism below a triangle near the cylinder. One model is made
//              from XML for each pair of shapes; poses are then set in mjData.
// Shapes       mujoco-heights:N is an hfield asset without heights. MuJoCo knows no other floor of
//              triangles: a mesh is its hull. Its prisms reach down to the asset's base, so that a
//              box is one of its own half extents, with squares on the face that is up in its
//              frame; a plane's base is as deep as its floor is wide.
// Conventions  The hfield comes first; the normal points from it to the cylinder. Its frame's
//              z = 0 is the surface.
// Points       Midway between the two surfaces, one for a prism, 50 at most; the 16 deepest are
//              kept.
// Threshold    Passed as the function's margin.
// Traps        MuJoCo wants heights above zero, though there are none, and the cylinder's bounding
//              radius, which the sizes in mjModel do not change: hence a model for each pair.
#include <cstddef>
#include <mujoco/mujoco.h>
#include <sstream>
#include <stdexcept>

#include "candidates/adapter.hpp"
#include "candidates/floor.hpp"
#include "candidates/mujoco_library.hpp"

namespace {

using touchstone::Floor;

constexpr int geom_floor = 0, geom_cylinder = 1;  // as in the XML

/// Half lengths along x and y, and the depth below the surface.
struct Extent {
  double x, y, base;
};

std::string model_xml(const ts_shape& a, const Extent& extent, int count) {
  std::ostringstream xml;
  xml.precision(17);
  xml << "<mujoco><size nstack='100000' njmax='1' nconmax='1'/><asset><hfield name='b' nrow='"
      << count + 1 << "' ncol='" << count + 1 << "' size='" << extent.x << ' ' << extent.y << ' '
      << 1 << ' ' << extent.base << "'/></asset><worldbody><geom type='hfield' hfield='b'/>"
      << "<body><freejoint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
      << "<geom type='cylinder' size='" << a.size[0] << ' ' << a.size[1]
      << "'/></body></worldbody></mujoco>";
  return xml.str();
}

}  // namespace

struct ts_prepared {
  ts_prepared(const ts_shape& a, const ts_shape& b, double given_threshold, int count)
      : floor(a, b, count),
        threshold(given_threshold),
        top(b.kind == TS_BOX ? b.size[2] : 0),
        scene(model_xml(a, extent_of(b), count)) {}

  Extent extent_of(const ts_shape& b) const {
    if (b.kind == TS_BOX) return {b.size[0], b.size[1], 2 * b.size[2]};
    const double width = floor.count() * floor.side();
    return {width / 2, width / 2, width};
  }

  Floor floor;
  double threshold, top;  ///< height of the surface in the frame
  touchstone::MujocoScene scene;
};

namespace {

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold,
                     double count) try {
  return new ts_prepared(*a, *b, threshold, static_cast<int>(count));
} catch (const std::runtime_error&) {
  return nullptr;  // no model can be made of the sizes
}

void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double*, ts_answer* answer) {
  const ts_pose at = p->floor.at(*a, *b);
  const double up[3] = {0, 0, p->top};
  double position[3];
  mju_rotVecQuat(position, up, at.orientation);
  mju_addTo3(position, at.position);
  p->scene.place(geom_floor, position, at.orientation);
  p->scene.place(geom_cylinder, a->position, a->orientation);
  mjContact contacts[mjMAXCONPAIR];
  const int count = mjCOLLISIONFUNC[mjGEOM_HFIELD][mjGEOM_CYLINDER](
      p->scene.model, p->scene.data, contacts, geom_floor, geom_cylinder, p->threshold);
  touchstone::adapter::begin(*answer);
  for (int i = 0; i < count; ++i) {
    touchstone::adapter::add_point(contacts[i].pos, contacts[i].frame, contacts[i].dist, *answer);
  }
}

using touchstone::adapter::release, touchstone::adapter::supports_flat;

const ts_candidate candidates[] = {
    {"mujoco-heights", mj_versionString(),
     "double precision; plane or box as an hfield of N by N squares without heights, whose prisms "
     "are asked libccd's MPR; the 16 deepest points, midway between the two surfaces",
     nullptr, &touchstone::floor_parameter, supports_flat, prepare, query, release, nullptr,
     nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
