// MuJoCo 2.2.2, double precision.
//
// Calls        The collision function that mj_collision takes from mjCOLLISIONFUNC for the two geom
//              types. One model per pair of types is made from XML; sizes and poses are then set in
//              mjModel and mjData, as users do.
// Routes       The plane is MuJoCo's own closed form; all others, in this version the sphere too,
//              go through libccd's MPR (mpr_tolerance 1e-6, mpr_iterations 50, both default).
//              Several contacts by mjENBL_MULTICCD are off, as by default.
// Shapes       Half lengths, a capsule's without its caps. A plane is solid below its frame's
//              xy-plane; ours is given such a frame. A convex body is a mesh asset of its vertices,
//              whose hull MuJoCo makes; it keeps them in single precision, about their centre of
//              mass and along their axes of inertia, and has none that is flat or of less than
//              1e-15 m³.
// Conventions  The lower geom type comes first; the normal points from it to the other one, and is
//              reversed if the cylinder is first.
// Cured        With TOUCHSTONE_CURED, Touchstone's contacts are installed in the table
//              (reference/engines/mujoco.hpp), and the candidate is mujoco+touchstone, which
//              answers separate bodies for all pairs.
// Points       Midway between the two surfaces.
// Threshold    Passed as the function's margin. Only the plane answers separate bodies.
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <mujoco/mujoco.h>
#include <sstream>
#include <stdexcept>
#include <string>

#include "candidates/adapter.hpp"
#include "candidates/mujoco_library.hpp"
#ifdef TOUCHSTONE_CURED
#include "reference/engines/mujoco.hpp"
#endif

namespace {

using touchstone::MujocoScene;

mjtGeom geom_type(ts_shape_kind kind) {
  switch (kind) {
    case TS_CYLINDER:
      return mjGEOM_CYLINDER;
    case TS_PLANE:
      return mjGEOM_PLANE;
    case TS_SPHERE:
      return mjGEOM_SPHERE;
    case TS_CAPSULE:
      return mjGEOM_CAPSULE;
    case TS_BOX:
      return mjGEOM_BOX;
    case TS_CONVEX:
      return mjGEOM_MESH;
  }
  return mjGEOM_NONE;
}

const char* type_name(ts_shape_kind kind) {
  constexpr const char* names[] = {"cylinder", "plane", "sphere", "capsule", "box", "mesh"};
  return names[kind];
}

/// The asset of a convex body; else nothing.
std::string asset_of(const ts_shape& other) {
  if (other.kind != TS_CONVEX) return "";
  std::ostringstream xml;
  xml.precision(std::numeric_limits<double>::max_digits10);
  xml << "<asset><mesh name='b' vertex='";
  for (const double x : touchstone::coordinates_of(other)) xml << x << ' ';
  xml << "'/></asset>";
  return xml.str();
}

/// A model with a free cylinder and another geom in the world, both of size one. Its stack and its
/// room for constraints, which a collision function does not use, are small: the usual ones of many
/// megabytes are written with zeros, which takes longer than a thousand queries.
std::string model_xml(const ts_shape& other) {
  return "<mujoco><size nstack='10000' njmax='1' nconmax='1'/>" + asset_of(other) +
         "<worldbody><geom type='" + type_name(other.kind) +
         (other.kind == TS_CONVEX ? "' mesh='b" : "' size='1 1 1") +
         "'/><body><freejoint/><geom type='cylinder' size='1 1'/>"
         "</body></worldbody></mujoco>";
}

/// The scene for one kind of shape, made on first use; for a convex body one of its own.
std::shared_ptr<const MujocoScene> scene_for(const ts_shape& other) {
  static std::map<ts_shape_kind, std::shared_ptr<const MujocoScene>> scenes;
  if (other.kind == TS_CONVEX) return std::make_shared<MujocoScene>(model_xml(other));
  auto& scene = scenes[other.kind];
  if (!scene) scene = std::make_shared<MujocoScene>(model_xml(other));
  return scene;
}

constexpr int geom_b = 0, geom_a = 1;  // as in the XML

}  // namespace

struct ts_prepared {
  std::shared_ptr<const MujocoScene> scene;
  ts_shape a, b;
  double threshold;
  mjfCollision collide;
  bool cylinder_first;
  double plane_frame[4];  // quaternion that turns z to the plane's normal
};

namespace {

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double) try {
#ifdef TOUCHSTONE_CURED
  touchstone::mujoco::install();
#endif
  const mjtGeom type = geom_type(b->kind);
  const bool cylinder_first = type >= mjGEOM_CYLINDER;
  const mjfCollision collide = cylinder_first ? mjCOLLISIONFUNC[mjGEOM_CYLINDER][type]
                                              : mjCOLLISIONFUNC[type][mjGEOM_CYLINDER];
  if (!collide) return nullptr;
  auto* const p =
      new ts_prepared{scene_for(*b), *a, *b, threshold, collide, cylinder_first, {1, 0, 0, 0}};
  if (b->kind == TS_PLANE) mju_quatZ2Vec(p->plane_frame, b->size);
  return p;
} catch (const std::runtime_error&) {
  return nullptr;  // no mesh can be made of the vertices
}

void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double*, ts_answer* answer) {
  // A model serves all pairs of the same kinds, so that its sizes are set with every query.
  const MujocoScene& scene = *p->scene;
  mju_copy3(scene.model->geom_size + std::ptrdiff_t{3} * geom_a, p->a.size);
  scene.place(geom_a, a->position, a->orientation);
  if (p->b.kind == TS_PLANE) {
    double orientation[4], normal[3], position[3];
    mju_mulQuat(orientation, b->orientation, p->plane_frame);
    mju_rotVecQuat(normal, p->b.size, b->orientation);
    mju_addScl3(position, b->position, normal, p->b.size[3]);
    scene.place(geom_b, position, orientation);
  } else if (p->b.kind == TS_CONVEX) {
    double orientation[4], position[3];
    mju_mulPose(position, orientation, b->position, b->orientation, scene.model->geom_pos,
                scene.model->geom_quat);
    scene.place(geom_b, position, orientation);
  } else {
    mju_copy3(scene.model->geom_size + std::ptrdiff_t{3} * geom_b, p->b.size);
    scene.place(geom_b, b->position, b->orientation);
  }
  mjContact contacts[mjMAXCONPAIR];
  const int count =
      p->collide(scene.model, scene.data, contacts, p->cylinder_first ? geom_a : geom_b,
                 p->cylinder_first ? geom_b : geom_a, p->threshold);
  touchstone::adapter::begin(*answer);
  for (int i = 0; i < count; ++i) {
    double normal[3];
    mju_scl3(normal, contacts[i].frame, p->cylinder_first ? -1 : 1);
    touchstone::adapter::add_point(contacts[i].pos, normal, contacts[i].dist, *answer);
  }
}

using touchstone::adapter::release;
#ifdef TOUCHSTONE_CURED
using touchstone::adapter::supports_primitives;
#else
using touchstone::adapter::supports_all;
#endif

const ts_candidate candidates[] = {
#ifdef TOUCHSTONE_CURED
    {"mujoco+touchstone", mj_versionString(),
     "double precision; the pair's function in mjCOLLISIONFUNC with Touchstone's contacts of "
     "cylinders installed",
     nullptr, nullptr, supports_primitives, prepare, query, release, nullptr, nullptr}};
#else
    {"mujoco", mj_versionString(),
     "double precision; the pair's function in mjCOLLISIONFUNC; plane analytic, others "
     "by libccd's MPR with MuJoCo's tolerance 1e-6; multiccd off",
     nullptr, nullptr, supports_all, prepare, query, release, nullptr, nullptr}};
#endif
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
