#include "touchstone_contacts.h"

#include <algorithm>
#include <string>

#include "contact_of.hpp"
#include "invalid_input.hpp"

namespace {

using touchstone::Configuration;
using touchstone::Cylinder;
using touchstone::Pose;
using touchstone::Vec3;

touchstone::Shape to_shape(const touchstone_body& body) {
  const double* s = body.size;
  switch (body.kind) {
    case TOUCHSTONE_CYLINDER:
      return Cylinder(s[0], s[1]);
    case TOUCHSTONE_PLANE:
      return touchstone::Plane(Vec3(s[0], s[1], s[2]), s[3]);
    case TOUCHSTONE_SPHERE:
      return touchstone::Sphere(s[0]);
    case TOUCHSTONE_CAPSULE:
      return touchstone::Capsule(s[0], s[1]);
    case TOUCHSTONE_BOX:
      return touchstone::Box(Vec3(s[0], s[1], s[2]));
  }
  throw touchstone::InvalidInput("kind", std::to_string(body.kind),
                                 "must be one of the five shapes");
}

Pose to_pose(const touchstone_body& body) {
  const double* q = body.orientation;
  return Pose(Vec3(body.position), Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}

/// Calls with the bodies' configuration and returns 0; or 1 if there is none.
template <class Question>
int ask(const touchstone_body* a, const touchstone_body* b, Question question) try {
  if (a->kind != TOUCHSTONE_CYLINDER) return 1;
  question(Configuration{Cylinder(a->size[0], a->size[1]), to_pose(*a), to_shape(*b), to_pose(*b)});
  return 0;
} catch (const touchstone::InvalidInput&) {
  return 1;
}

void copy(const Vec3& from, double (&to)[3]) { std::copy_n(from.data(), 3, to); }

}  // namespace

int touchstone_find_contact(const touchstone_body* a, const touchstone_body* b, double threshold,
                            touchstone_contact* contact) {
  return ask(a, b, [&](const Configuration& c) {
    const touchstone::Contact found = touchstone::contact(c, threshold);
    copy(found.normal, contact->normal);
    contact->signed_distance = found.signed_distance;
    contact->point_count = 0;
    for (const touchstone::ContactPoint& p : found.points()) {
      touchstone_contact_point& point = contact->points[contact->point_count++];
      copy(p.position, point.position);
      point.depth = p.depth;
    }
  });
}

int touchstone_find_signed_distance(const touchstone_body* a, const touchstone_body* b,
                                    double* signed_distance, double normal[3]) {
  return ask(a, b, [&](const Configuration& c) {
    const touchstone::SignedDistance found = touchstone::signed_distance(c);
    *signed_distance = found.value;
    std::copy_n(found.normal.data(), 3, normal);
  });
}

int touchstone_find_overlap(const touchstone_body* a, const touchstone_body* b, int* overlap) {
  return ask(a, b, [&](const Configuration& c) { *overlap = touchstone::overlaps(c) ? 1 : 0; });
}
