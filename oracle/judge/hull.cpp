#include "oracle/judge/hull.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace touchstone {
namespace {

using oracle::ContactPatch;

double distance_in_space(const Vec3& point, const ContactPatch& patch) {
  const double beside = patch.distance(point);
  return std::hypot(beside, (point - patch.in_world(patch.in_plane(point))).norm());
}

double farthest(const ContactPatch& from, const ContactPatch& to) {
  double max = 0;
  for (const Vec3& point : from.outline()) max = std::max(max, distance_in_space(point, to));
  return max;
}

}  // namespace

ContactPatch hull_of_points(const ts_answer& answer) {
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < answer.point_count; ++i) mean += Vec3(answer.points[i].position);
  mean /= answer.point_count;
  const Vec3 n = Vec3(answer.normal).normalized();
  const Vec3 e1 = n.unitOrthogonal();
  const ContactPatch::Plane plane{mean, e1, n.cross(e1)};
  std::vector<oracle::Vec2> flat;
  for (int i = 0; i < answer.point_count; ++i) {
    const Vec3 from_mean = Vec3(answer.points[i].position) - mean;
    flat.emplace_back(from_mean.dot(plane.e1), from_mean.dot(plane.e2));
  }
  return {plane, oracle::ConvexSet::polygon(oracle::plane_hull(flat))};
}

double movement(const ContactPatch& from, const ContactPatch& to) {
  return std::max(farthest(from, to), farthest(to, from));
}

}  // namespace touchstone
