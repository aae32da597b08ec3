#pragma once

// Exact contacts of cylinders inside ODE: include this and call touchstone::ode::install() after
// dInitODE. dCollide then asks Touchstone for every pair with a cylinder (cylinder, box, capsule,
// sphere, plane, in both orders, in spaces and transforms); other pairs stay ODE's own.
//
// Points       As many as dCollide is asked for, at most eight; of more than that those that span
//              most (reduce_points.hpp). ODE's own colliders give 1 to 8. CONTACTS_UNIMPORTANT
//              changes nothing.
// Conventions  ODE's: the normal points into the first geom, depths are positive, positions are
//              halfway between the surfaces. The sides (triangles) are -1.
// Margin       None, as in ODE: bodies that are apart have no contact.
// Threads      The colliders keep nothing, so that threads may collide at once. The table is one
// for
//              the process: install while no thread collides.
// Invalid      Lengths of zero, and poses that are not finite, have no contacts.
// Versions     0.16.2, double precision; single precision compiles and is rounded.
#include <algorithm>
#include <ode/ode.h>
#include <utility>

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

inline Pose pose_of(dGeomID geom) {
  const dReal* x = dGeomGetPosition(geom);
  dQuaternion q;
  dGeomGetQuaternion(geom, q);
  return Pose(Vec3(x[0], x[1], x[2]), Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}

/// A geom's shape and pose; ODE's lengths are full, those of capsules without their caps.
template <class Shape>
struct Posed;

template <>
struct Posed<Cylinder> {
  static Cylinder shape(dGeomID geom) {
    dReal radius, length;
    dGeomCylinderGetParams(geom, &radius, &length);
    return Cylinder(radius, length / 2);
  }
  static Pose pose(dGeomID geom) { return pose_of(geom); }
};

template <>
struct Posed<Capsule> {
  static Capsule shape(dGeomID geom) {
    dReal radius, length;
    dGeomCapsuleGetParams(geom, &radius, &length);
    return Capsule(radius, length / 2);
  }
  static Pose pose(dGeomID geom) { return pose_of(geom); }
};

template <>
struct Posed<Box> {
  static Box shape(dGeomID geom) {
    dVector3 lengths;
    dGeomBoxGetLengths(geom, lengths);
    return Box(Vec3(lengths[0], lengths[1], lengths[2]) / 2);
  }
  static Pose pose(dGeomID geom) { return pose_of(geom); }
};

template <>
struct Posed<Sphere> {
  static Sphere shape(dGeomID geom) { return Sphere(dGeomSphereGetRadius(geom)); }
  static Pose pose(dGeomID geom) {
    const dReal* x = dGeomGetPosition(geom);
    return Pose(Vec3(x[0], x[1], x[2]));
  }
};

template <>
struct Posed<Plane> {  // has no pose
  static Plane shape(dGeomID geom) {
    dVector4 p;
    dGeomPlaneGetParams(geom, p);
    return Plane(Vec3(p[0], p[1], p[2]), p[3]);
  }
  static Pose pose(dGeomID) { return Pose(); }
};

/// A collider as ODE calls it: of a cylinder and another geom.
template <class Other>
int collide(dGeomID a, dGeomID b, int flags, dContactGeom* contacts, int skip) try {
  Contact c = contact(Posed<Cylinder>::shape(a), Posed<Cylinder>::pose(a), Posed<Other>::shape(b),
                      Posed<Other>::pose(b), 0, nullptr, PointRange::within_threshold);
  constexpr int count_mask = 0xffff;
  reduce_points(c, std::max(1, flags & count_mask));
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
} catch (const InvalidInput&) {
  return 0;
}

#ifdef TOUCHSTONE_ODE_CAN_UNINSTALL
/// dSetColliderOverride marks a collider of one class twice as one for exchanged geoms, which
/// ODE's own is not: exchanged once more, bit for bit as before.
inline int collide_exchanged(dGeomID a, dGeomID b, int flags, dContactGeom* contacts, int skip) {
  const int count = dCollideCylinderCylinder(b, a, flags, contacts, skip);
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

inline bool is_installed = false;
inline bool libccd_had_box = false;

}  // namespace detail

/// Gives every pair with a cylinder to Touchstone. After dInitODE, while no thread collides.
inline void install() {
#ifdef TOUCHSTONE_ODE_CAN_UNINSTALL
  if (!detail::is_installed) detail::libccd_had_box = detail::box_is_asked_of_libccd();
#endif
  dSetColliderOverride(dCylinderClass, dPlaneClass, detail::collide<Plane>);
  dSetColliderOverride(dCylinderClass, dSphereClass, detail::collide<Sphere>);
  dSetColliderOverride(dCylinderClass, dCapsuleClass, detail::collide<Capsule>);
  dSetColliderOverride(dCylinderClass, dCylinderClass, detail::collide<Cylinder>);
  dSetColliderOverride(dCylinderClass, dBoxClass, detail::collide<Box>);
  detail::is_installed = true;
}

/// Gives them back to ODE; false where its library does not show its own colliders.
inline bool uninstall() {
  if (!detail::is_installed) return true;
#ifdef TOUCHSTONE_ODE_CAN_UNINSTALL
  if (!dCollideCylinderPlane) return false;
  dSetColliderOverride(dCylinderClass, dPlaneClass, dCollideCylinderPlane);
  dSetColliderOverride(dCylinderClass, dSphereClass, dCollideCylinderSphere);
  dSetColliderOverride(dCapsuleClass, dCylinderClass, dCollideCapsuleCylinder);
  dSetColliderOverride(dCylinderClass, dCylinderClass,
                       dCollideCylinderCylinder ? detail::collide_exchanged : nullptr);
  if (detail::libccd_had_box) {
    dSetColliderOverride(dBoxClass, dCylinderClass, dCollideBoxCylinderCCD);
  } else {
    dSetColliderOverride(dCylinderClass, dBoxClass, dCollideCylinderBox);
  }
  detail::is_installed = false;
  return true;
#else
  return false;
#endif
}

}  // namespace touchstone::ode
