#pragma once

// Exact contacts of cylinders inside MuJoCo: include this and call touchstone::mujoco::install().
// Its table mjCOLLISIONFUNC then asks Touchstone for a cylinder against a plane, sphere, capsule,
// cylinder or box; other pairs, height fields, meshes and ellipsoids among them, stay MuJoCo's own.
//
// Points       All of them, at most eight, where MuJoCo's own functions have 4 with a plane and 1
//              otherwise (up to 5 by mjENBL_MULTICCD). MuJoCo 3.9 and later leave room for as many
//              as mj_maxContact says: of more, those that span most (reduce_points.hpp).
// Conventions  MuJoCo's: the normal is the frame's first axis and points from the first geom to
//              the second; positions are halfway; the second axis is left to mju_makeFrame, as
//              MuJoCo's own functions for cylinders leave it.
// Margin       That of the call (of both geoms, or the pair): bodies closer than it have contacts,
//              of positive distance. What the gap excludes MuJoCo decides from that.
// Threads      The functions keep nothing, so that threads may step models at once. The table is
//              one for the process: install while no thread steps.
// Invalid      Poses that are not finite have no contacts. Sizes of zero, which a program may
//              write into a model, stay MuJoCo's.
// Versions     2.2.2. 3.0 to 3.12 by their headers: mjfCollision writes mjContact before 3.9 and
//              mjPreContact from then on, and its mjData is const before 3.7. mj_geomDistance
//              of 3.x does not ask the table if native CCD is on and the pair is one that MuJoCo
//              gives it; Touchstone's functions are not, so that it asks them.
#include <cstddef>
#include <mujoco/mujoco.h>

#include "../contact_of.hpp"
#include "../reduce_points.hpp"
#include "../touchstone.hpp"

namespace touchstone::mujoco {
namespace detail {

// Up to 3.4.0 the version was written in three digits, and now is in seven.
#if mjVERSION_HEADER >= 3009000
using Data = mjData;
using Written = mjPreContact;
inline int room(const mjModel* m, int g1, int g2, mjtNum margin) {
  return mj_maxContact(m, g1, g2, margin > 0);
}
inline void write_frame(Written& out, const Vec3& normal) {
  for (int i = 0; i < 3; ++i) out.normal[i] = normal[i], out.tangent[i] = 0;
}
#else
#if mjVERSION_HEADER >= 3007000
using Data = mjData;
#else
using Data = const mjData;
#endif
using Written = mjContact;
inline int room(const mjModel*, int, int, mjtNum) { return Contact::max_points; }
inline void write_frame(Written& out, const Vec3& normal) {
  for (int i = 0; i < 3; ++i) out.frame[i] = normal[i], out.frame[3 + i] = 0;
}
#endif

template <class Shape>
Shape shape_of(const mjtNum* size);
template <>
inline Cylinder shape_of(const mjtNum* size) {
  return Cylinder(size[0], size[1]);
}
template <>
inline Capsule shape_of(const mjtNum* size) {
  return Capsule(size[0], size[1]);
}
template <>
inline Box shape_of(const mjtNum* size) {
  return Box(Vec3(size[0], size[1], size[2]));
}
template <>
inline Sphere shape_of(const mjtNum* size) {
  return Sphere(size[0]);
}
template <>
inline Plane shape_of(const mjtNum*) {  // its sizes are drawn only
  return Plane(Vec3::UnitZ(), 0);
}

inline Pose pose_of(const mjData* d, std::ptrdiff_t geom) {
  const mjtNum *x = d->geom_xpos + 3 * geom, *r = d->geom_xmat + 9 * geom;
  Eigen::Matrix3d rotation;
  rotation << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
  return Pose(Vec3(x[0], x[1], x[2]), Eigen::Quaterniond(rotation));
}

/// MuJoCo's own function for a cylinder and this shape, once it is replaced.
template <class Other>
inline mjfCollision own = nullptr;

/// A shape without an interior, which XML cannot make but a program can, stays MuJoCo's own.
template <class Other>
bool has_interior(const mjtNum* size) try {
  shape_of<Other>(size);
  return true;
} catch (const InvalidInput&) {
  return false;
}

/// A function of the table: MuJoCo gives it the geom of the lower type first.
template <class Other, bool cylinder_is_first>
int collide(const mjModel* m, Data* d, Written* contacts, int g1, int g2, mjtNum margin) try {
  const std::ptrdiff_t a = cylinder_is_first ? g1 : g2, b = cylinder_is_first ? g2 : g1;
  const mjtNum *size_a = m->geom_size + 3 * a, *size_b = m->geom_size + 3 * b;
  if (!has_interior<Cylinder>(size_a) || !has_interior<Other>(size_b)) {
    return own<Other>(m, d, contacts, g1, g2, margin);
  }
  const Configuration bodies{shape_of<Cylinder>(size_a), pose_of(d, a), shape_of<Other>(size_b),
                             pose_of(d, b)};
  Contact c = contact(bodies, margin, nullptr, PointRange::within_threshold);
  if (c.points().empty()) return 0;
  reduce_points(c, room(m, g1, g2, margin), 1e-9, unseen_lack(bodies));
  const Vec3 normal = cylinder_is_first ? Vec3(-c.normal) : c.normal;
  for (const ContactPoint& p : c.points()) {
    Written& out = *contacts++;
    out.dist = -p.depth;
    for (int i = 0; i < 3; ++i) out.pos[i] = p.position[i];
    write_frame(out, normal);
  }
  return static_cast<int>(c.points().size());
} catch (const InvalidInput&) {
  return 0;
}

/// A place of the table, its function here, and where MuJoCo's own is kept.
struct Entry {
  int type1, type2;
  mjfCollision ours;
  mjfCollision& own;
};
inline const Entry entries[] = {
    {mjGEOM_PLANE, mjGEOM_CYLINDER, collide<Plane, false>, own<Plane>},
    {mjGEOM_SPHERE, mjGEOM_CYLINDER, collide<Sphere, false>, own<Sphere>},
    {mjGEOM_CAPSULE, mjGEOM_CYLINDER, collide<Capsule, false>, own<Capsule>},
    {mjGEOM_CYLINDER, mjGEOM_CYLINDER, collide<Cylinder, true>, own<Cylinder>},
    {mjGEOM_CYLINDER, mjGEOM_BOX, collide<Box, true>, own<Box>}};

}  // namespace detail

/// Gives every pair with a cylinder to Touchstone, of all models. While no thread steps.
inline void install() {
  for (const auto& [type1, type2, ours, own] : detail::entries) {
    mjfCollision& place = mjCOLLISIONFUNC[type1][type2];
    if (place == ours) continue;
    own = place;
    place = ours;
  }
}

/// Gives them back to the functions that they were taken from.
inline void uninstall() {
  for (const auto& [type1, type2, ours, own] : detail::entries) {
    mjfCollision& place = mjCOLLISIONFUNC[type1][type2];
    if (place == ours) place = own;
  }
}

}  // namespace touchstone::mujoco
