// The box replaced by spheres or capsules, against an unchanged cylinder: the third simplification
// of the thesis from which Touchstone grew (its chapter 3.6.2).
//
// Models       box-capsules:N and box-spheres:N are capsules_in_box and spheres_in_box (model.hpp).
// Calls        Touchstone's own cylinder–sphere and cylinder–capsule routines, once for each part.
// Conventions  Those of candidate.h; up to 16 points, the deepest.
// Threshold    Passed on.
#include <algorithm>
#include <limits>
#include <vector>

#include "candidates/adapter.hpp"
#include "candidates/model.hpp"
#include "reference/contact.hpp"

using touchstone::BoxParts;
using touchstone::Contact;
using touchstone::Pose;
using touchstone::Vec3;
using touchstone::adapter::copy;

namespace {

Pose to_pose(const ts_pose& p) {
  const double* q = p.orientation;
  return Pose(touchstone::position_of(p), Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}

}  // namespace

struct ts_prepared {
  touchstone::Cylinder cylinder;
  BoxParts parts;
  double threshold;

  /// Contact of the cylinder with one part, up to `reach` apart.
  Contact contact(const Pose& a, const Pose& b, const Vec3& centre, double reach) const {
    const Pose at(b.position() + b.orientation() * centre, b.orientation() * parts.along);
    if (parts.half_length > 0) {
      const touchstone::Capsule capsule(parts.radius, parts.half_length);
      return touchstone::contact(cylinder, a, capsule, at, reach);
    }
    return touchstone::contact(cylinder, a, touchstone::Sphere(parts.radius), at, reach);
  }
};

namespace {

template <bool as_capsules>
ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double count) {
  const auto in_box = as_capsules ? touchstone::capsules_in_box : touchstone::spheres_in_box;
  return new ts_prepared{touchstone::Cylinder(a->size[0], a->size[1]),
                         in_box(Vec3(b->size[0], b->size[1], b->size[2]), static_cast<int>(count)),
                         threshold};
}

void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double*, ts_answer* answer) {
  const Pose pose_a = to_pose(*a), pose_b = to_pose(*b);
  answer->status = TS_NONE;
  answer->point_count = 0;
  std::vector<ts_point> points;
  for (const Vec3& centre : p->parts.centres) {
    const Contact c = p->contact(pose_a, pose_b, centre, p->threshold);
    if (!(c.signed_distance <= p->threshold)) continue;
    if (answer->status == TS_NONE || c.signed_distance < answer->signed_distance) {
      answer->status = TS_CONTACT;
      answer->signed_distance = c.signed_distance;
      copy(c.normal, answer->normal);
    }
    for (const auto& point : c.points()) {
      ts_point& out = points.emplace_back();
      copy(point.position, out.position);
      copy(c.normal, out.normal);
      out.depth = point.depth;
    }
  }
  const std::size_t kept = std::min<std::size_t>(points.size(), TOUCHSTONE_MAX_POINTS);
  std::partial_sort(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(kept),
                    points.end(),
                    [](const ts_point& x, const ts_point& y) { return x.depth > y.depth; });
  std::copy_n(points.begin(), kept, answer->points);
  answer->point_count = static_cast<int>(kept);
}

double model_distance(ts_prepared* p, const ts_pose* a, const ts_pose* b) {
  const Pose pose_a = to_pose(*a), pose_b = to_pose(*b);
  double min = std::numeric_limits<double>::infinity();
  for (const Vec3& centre : p->parts.centres) {
    const double anywhere = std::numeric_limits<double>::max();
    min = std::min(min, p->contact(pose_a, pose_b, centre, anywhere).signed_distance);
  }
  return min;
}

int supports(void*, ts_shape_kind kind) { return kind == TS_BOX; }
using touchstone::adapter::release;

const ts_parameter spheres = {"number of spheres along the longest axis", 1, 64, 8, 1, 0};
const ts_parameter capsules = {"number of capsules", 1, 64, 4, 1, 0};

const ts_candidate candidates[] = {
    {"box-spheres", TOUCHSTONE_VERSION,
     "double precision; Touchstone's cylinder and sphere, once for each part; exact for its model",
     "the box as spheres inside it, of its smallest half extent, in a grid", &spheres, supports,
     prepare<false>, query, release, model_distance, nullptr},
    {"box-capsules", TOUCHSTONE_VERSION,
     "double precision; Touchstone's cylinder and capsule, once for each part; exact for its model",
     "the box as capsules inside it, of its smallest half extent, side by side", &capsules,
     supports, prepare<true>, query, release, model_distance, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
