// Coal 3 (formerly HPP-FCL, of Pinocchio), double precision.
//
// Calls        coal        coal::collide with a default CollisionRequest: GJK to 1e-6, then EPA to
//                          1e-6.
//              coal-patch  the same, then coal::computeContactPatch with a default request: the
//                          polygon in which the two shapes' supports along the normal meet.
// Routes       Half-space and sphere are Coal's own closed forms; all others GJK and EPA.
// Shapes       Cylinder and Capsule by full length, the capsule's without its caps; Box by full
//              lengths; a plane is a Halfspace, solid where n·x <= d.
// Conventions  The normal points from object 1 to object 2 and is reversed. penetration_depth is,
//              contrary to its name, the signed distance: negative inside (collision_data.h).
// Points       coal: one, midway between the two nearest points. coal-patch: the polygon's corners,
//              midway, all with the depth of the deepest; at most 16, evenly chosen.
// Threshold    security_margin.
// Casts        None: Coal left FCL's continuousCollide out (coal#421).
// Version      Of the installed package; not in Debian 12. Built where CMake finds coal's package.
#include <algorithm>
#include <coal/collision.h>
#include <coal/contact_patch.h>
#include <coal/shape/geometric_shapes.h>
#include <memory>

#include "candidates/adapter.hpp"

namespace {

using Vector = coal::Vec3s;
using Geometry = std::unique_ptr<coal::CollisionGeometry>;

Geometry make_geometry(const ts_shape& shape) {
  const double* s = shape.size;
  switch (shape.kind) {
    case TS_CYLINDER:
      return std::make_unique<coal::Cylinder>(s[0], 2 * s[1]);
    case TS_PLANE:
      return std::make_unique<coal::Halfspace>(Vector(s[0], s[1], s[2]), s[3]);
    case TS_SPHERE:
      return std::make_unique<coal::Sphere>(s[0]);
    case TS_CAPSULE:
      return std::make_unique<coal::Capsule>(s[0], 2 * s[1]);
    case TS_BOX:
      return std::make_unique<coal::Box>(2 * s[0], 2 * s[1], 2 * s[2]);
    case TS_CONVEX:
      break;  // not supported
  }
  return nullptr;
}

coal::Transform3s to_transform(const ts_pose& p) {
  const double* q = p.orientation;
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(),
          Vector(p.position[0], p.position[1], p.position[2])};
}

}  // namespace

struct ts_prepared {
  Geometry a, b;
  coal::CollisionRequest request;
};

namespace {

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double) {
  auto* const p = new ts_prepared{make_geometry(*a), make_geometry(*b), {}};
  p->request.security_margin = threshold;
  return p;
}

template <bool patch>
void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double*, ts_answer* answer) {
  const coal::Transform3s at_a = to_transform(*a), at_b = to_transform(*b);
  coal::CollisionResult result;
  coal::collide(p->a.get(), at_a, p->b.get(), at_b, p->request, result);
  touchstone::adapter::begin(*answer);
  if (!result.isCollision()) return;
  const coal::Contact& contact = result.getContact(0);
  const auto add = [&](const Vector& position) {
    touchstone::adapter::add_point(position, Vector(-contact.normal), contact.penetration_depth,
                                   *answer);
  };
  if (patch) {
    const coal::ContactPatchRequest patch_request;
    coal::ContactPatchResult patches;
    coal::computeContactPatch(p->a.get(), at_a, p->b.get(), at_b, result, patch_request, patches);
    if (patches.numContactPatches() > 0) {
      const coal::ContactPatch& found = patches.getContactPatch(0);
      const std::size_t count = std::min<std::size_t>(found.size(), TOUCHSTONE_MAX_POINTS);
      for (std::size_t i = 0; i < count; ++i) add(found.getPoint(i * found.size() / count));
    }
  }
  if (answer->point_count == 0) add(contact.pos);
}

using touchstone::adapter::release, touchstone::adapter::supports_primitives;

const ts_candidate candidates[] = {
    {"coal", TOUCHSTONE_COAL_VERSION,
     "double precision; collide with default settings (GJK and EPA to 1e-6; half-space and sphere "
     "analytic)",
     nullptr, nullptr, supports_primitives, prepare, query<false>, release, nullptr, nullptr},
    {"coal-patch", TOUCHSTONE_COAL_VERSION,
     "double precision; collide, then computeContactPatch, with default settings", nullptr, nullptr,
     supports_primitives, prepare, query<true>, release, nullptr, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
