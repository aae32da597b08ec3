// The box replaced by spheres or capsules, against an unchanged cylinder: the third simplification
// of the thesis from which Touchstone grew (its chapter 3.6.2).
//
// Models       The radius is the box's smallest half extent. box-capsules:N is N capsules along
//              the longest axis, side by side along the middle one; box-spheres:N is N spheres
//              along the longest axis, in enough rows along the middle one that gaps there are no
//              wider. All lie inside the box and reach its faces; its edges and corners are lost.
// Calls        Touchstone's own cylinder–sphere and cylinder–capsule routines, once for each part.
// Conventions  Those of candidate.h; up to 16 points, the deepest.
// Threshold    Passed on.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "candidates/candidate.h"
#include "candidates/model.hpp"
#include "reference/cylinder_capsule.hpp"
#include "reference/cylinder_sphere.hpp"

using touchstone::Contact;
using touchstone::Pose;
using touchstone::Vec3;

namespace {

/// The parts in the box's frame, and the rotation of a capsule.
struct Parts {
  std::vector<Vec3> centres;
  double radius, half_length;
  Eigen::Quaterniond along;  ///< rotates z to the longest axis
};

double place(double reach, int i, int count) {
  return count == 1 ? 0 : reach * (2.0 * i / (count - 1) - 1);
}

Parts parts_of(const ts_shape& box, int count, bool as_capsules) {
  std::array<int, 3> axis = {0, 1, 2};  // axes of the smallest, middle and largest half extent
  std::sort(axis.begin(), axis.end(), [&](int i, int j) { return box.size[i] < box.size[j]; });
  const double radius = box.size[axis[0]];
  const double middle = box.size[axis[1]] - radius, longest = box.size[axis[2]] - radius;
  Parts parts{{},
              radius,
              as_capsules ? longest : 0,
              Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), Vec3::Unit(axis[2]))};
  const int in_row = as_capsules ? 1 : count;
  int rows = count;
  if (!as_capsules) {
    rows = middle > 0 && longest > 0
               ? 1 + static_cast<int>(std::ceil(middle / longest * (count - 1)))
               : 1;
  } else if (middle == 0) {
    rows = 1;
  }
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < in_row; ++i) {
      parts.centres.emplace_back(place(middle, row, rows) * Vec3::Unit(axis[1]) +
                                 place(longest, i, in_row) * Vec3::Unit(axis[2]));
    }
  }
  return parts;
}

Pose to_pose(const ts_pose& p) {
  const double* q = p.orientation;
  return Pose(touchstone::position_of(p), Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}

void copy(const Vec3& from, double (&to)[3]) { std::copy(from.data(), from.data() + 3, to); }

}  // namespace

struct ts_prepared {
  touchstone::Cylinder cylinder;
  Parts parts;
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
  return new ts_prepared{touchstone::Cylinder(a->size[0], a->size[1]),
                         parts_of(*b, static_cast<int>(count), as_capsules), threshold};
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
void release(ts_prepared* prepared) { delete prepared; }

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
const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 2, candidates, nullptr, 0};

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
