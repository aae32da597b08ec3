#pragma once

// Exact contacts of cylinders inside ODE: include this and call touchstone::ode::install() after
// dInitODE. dCollide then asks Touchstone for every pair with a cylinder (cylinder, box, capsule,
// sphere, plane, in both orders, in spaces and transforms); other pairs stay ODE's own.
//
// Points       As many as dCollide is asked for, at most eight; of more than that those that span
//              most (reduce_points.hpp). CONTACTS_UNIMPORTANT changes nothing.
// Conventions  ODE's: the normal points into the first geom, depths are positive, positions are
//              halfway between the surfaces. The sides (triangles) are -1.
// Margin       None, as in ODE: bodies that are apart have no contact.
// Threads      Threads may collide at once. The table is the process's: install while none does.
// Sizes        A capsule of zero length is a sphere. Other sizes of zero stay with ODE's own
//              colliders; where it has none that can take them, they have no contacts.
// Invalid      Poses that are not finite have no contacts.
// Versions     0.16.2, double precision; single precision compiles and is rounded.
#include <algorithm>
#include <ode/ode.h>
#include <optional>
#include <utility>

#include "../contact_of.hpp"
#include "../reduce_points.hpp"
#include "../touchstone.hpp"

// ODE's own colliders, which dSetColliderOverride cannot give back: no header has them, but its
// libraries export them. Those that a build lacks are null.
#if defined(__GNUC__) && !defined(_WIN32)
#define TOUCHSTONE_ODE_COLLIDER(name) \
  __attribute__((weak)) int name(dxGeom*, dxGeom*, int, dContactGeom*, int);
TOUCHSTONE_ODE_COLLIDER(dCollideCylinderPlane)
TOUCHSTONE_ODE_COLLIDER(dCollideCylinderSphere)
TOUCHSTONE_ODE_COLLIDER(dCollideCapsuleCylinder)
TOUCHSTONE_ODE_COLLIDER(dCollideCylinderCylinder)
TOUCHSTONE_ODE_COLLIDER(dCollideCylinderBox)
TOUCHSTONE_ODE_COLLIDER(dCollideBoxCylinderCCD)
#undef TOUCHSTONE_ODE_COLLIDER
#define TOUCHSTONE_ODE_CAN_UNINSTALL 1
#endif

namespace touchstone::ode {
namespace detail {

/// A geom's pose. dGeomGetQuaternion would not do: inside a dGeomTransform it gives the body's.
inline Pose pose_of(dGeomID geom) {
  const dReal *x = dGeomGetPosition(geom), *r = dGeomGetRotation(geom);  // rows of four
  Eigen::Matrix3d rotation;
  rotation << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  return Pose(Vec3(x[0], x[1], x[2]), Eigen::Quaterniond(rotation));
}

/// A geom's shape; none if a size is zero. ODE's lengths are full, those of capsules without caps.
inline std::optional<Shape> shape_of(dGeomID geom) try {
  dReal radius, length;
  dVector4 v;
  switch (dGeomGetClass(geom)) {
    case dCylinderClass:
      dGeomCylinderGetParams(geom, &radius, &length);
      return Cylinder(radius, length / 2);
    case dCapsuleClass:
      dGeomCapsuleGetParams(geom, &radius, &length);
      if (length == 0) return Sphere(radius);
      return Capsule(radius, length / 2);
    case dSphereClass:
      return Sphere(dGeomSphereGetRadius(geom));
    case dBoxClass:
      dGeomBoxGetLengths(geom, v);
      return Box(Vec3(v[0], v[1], v[2]) / 2);
    default:
      dGeomPlaneGetParams(geom, v);
      return Plane(Vec3(v[0], v[1], v[2]), v[3]);
  }
} catch (const InvalidInput&) {
  return {};
}

using Collider = int(dGeomID, dGeomID, int, dContactGeom*, int);

#ifdef TOUCHSTONE_ODE_CAN_UNINSTALL
/// Calls a collider with the geoms exchanged and turns its contacts round, as dCollide does.
template <Collider* collider>
int exchanged(dGeomID a, dGeomID b, int flags, dContactGeom* contacts, int skip) {
  const int count = collider ? collider(b, a, flags, contacts, skip) : 0;
  char* at = reinterpret_cast<char*>(contacts);
  for (int i = 0; i < count; ++i, at += skip) {
    dContactGeom& c = *reinterpret_cast<dContactGeom*>(at);
    for (int k = 0; k < 3; ++k) c.normal[k] = -c.normal[k];
    std::swap(c.g1, c.g2);
    std::swap(c.side1, c.side2);
  }
  return count;
}

/// Whether ODE was built to ask libccd for a cylinder and a box: it has one point for a cap.
inline bool box_is_asked_of_libccd() {
  const dGeomID cylinder = dCreateCylinder(nullptr, 1, 2), box = dCreateBox(nullptr, 4, 4, 2);
  dGeomSetPosition(cylinder, 0, 0, dReal(1.9));
  dContactGeom contacts[8];
  const int count = dCollide(cylinder, box, 8, contacts, sizeof(dContactGeom));
  dGeomDestroy(cylinder);
  dGeomDestroy(box);
  return count == 1;
}
#endif

inline bool is_installed = false, libccd_had_box = false;

/// ODE's own collider of a cylinder and a geom of another class, in this order; null where its
/// library does not show it. (dSetColliderOverride takes that of two cylinders for exchanged.)
inline Collider* own_collider([[maybe_unused]] int other_class) {
#ifdef TOUCHSTONE_ODE_CAN_UNINSTALL
  if (!dCollideCylinderPlane) return nullptr;
  if (other_class == dPlaneClass) return dCollideCylinderPlane;
  if (other_class == dSphereClass) return dCollideCylinderSphere;
  if (other_class == dCapsuleClass) return exchanged<dCollideCapsuleCylinder>;
  if (other_class == dCylinderClass) return exchanged<dCollideCylinderCylinder>;
  return libccd_had_box ? exchanged<dCollideBoxCylinderCCD> : dCollideCylinderBox;
#else
  return nullptr;
#endif
}

/// Answers for a cylinder and a geom of another class of which one has a size of zero. ODE ends the
/// process for a flat box, and where it would ask libccd for a flat cylinder.
inline int collide_flat(dGeomID a, dGeomID b, int flags, dContactGeom* contacts, int skip) {
  const int other = dGeomGetClass(b);
  const bool has_answer = other == dPlaneClass || other == dSphereClass ||
                          (other == dCapsuleClass && shape_of(a)) ||
                          (other == dBoxClass && shape_of(b) && !libccd_had_box);
  Collider* const own = has_answer ? own_collider(other) : nullptr;
  return own ? own(a, b, flags, contacts, skip) : 0;
}

/// A collider as ODE calls it: of a cylinder and another geom.
inline int collide(dGeomID a, dGeomID b, int flags, dContactGeom* contacts, int skip) try {
  const std::optional<Shape> shape_a = shape_of(a), shape_b = shape_of(b);
  if (!shape_a || !shape_b) return collide_flat(a, b, flags, contacts, skip);
  const Pose pose_b = dGeomGetClass(b) == dPlaneClass ? Pose() : pose_of(b);  // a plane has none
  const Configuration bodies{std::get<Cylinder>(*shape_a), pose_of(a), *shape_b, pose_b};
  Contact c = contact(bodies, 0, nullptr, PointRange::within_threshold);
  constexpr int count_mask = 0xffff;
  reduce_points(c, std::max(1, flags & count_mask), 1e-9, unseen_lack(bodies));
  char* at = reinterpret_cast<char*>(contacts);
  for (const ContactPoint& p : c.points()) {
    dContactGeom& out = *reinterpret_cast<dContactGeom*>(at);
    for (int i = 0; i < 3; ++i) {
      out.pos[i] = static_cast<dReal>(p.position[i]);
      out.normal[i] = static_cast<dReal>(c.normal[i]);
    }
    out.depth = static_cast<dReal>(std::max(0.0, p.depth));
    out.g1 = a, out.g2 = b;
    out.side1 = out.side2 = -1;
    at += skip;
  }
  return static_cast<int>(c.points().size());
} catch (const InvalidInput&) {  // of a pose
  return 0;
}

inline constexpr int other_classes[] = {dPlaneClass, dSphereClass, dCapsuleClass, dCylinderClass,
                                        dBoxClass};

}  // namespace detail

/// Gives every pair with a cylinder to Touchstone. After dInitODE, while no thread collides.
inline void install() {
#ifdef TOUCHSTONE_ODE_CAN_UNINSTALL
  if (!detail::is_installed) detail::libccd_had_box = detail::box_is_asked_of_libccd();
#endif
  for (const int other : detail::other_classes) {
    dSetColliderOverride(dCylinderClass, other, detail::collide);
  }
  detail::is_installed = true;
}

/// Gives them back to ODE; false where its library does not show its own colliders.
inline bool uninstall() {
  if (!detail::is_installed) return true;
  if (!detail::own_collider(dPlaneClass)) return false;
  for (const int other : detail::other_classes) {
    dSetColliderOverride(dCylinderClass, other, detail::own_collider(other));
  }
  detail::is_installed = false;
  return true;
}

}  // namespace touchstone::ode
