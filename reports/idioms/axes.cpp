#include "reports/idioms/axes.hpp"

#include <cmath>
#include <variant>

namespace touchstone {
namespace {

Pose renamed_pose(const Pose& pose, char axis) {
  const Eigen::Quaterniond& q = pose.orientation();
  const Vec3 u = renamed(Vec3(q.x(), q.y(), q.z()), axis);
  return {renamed(pose.position(), axis), Eigen::Quaterniond(q.w(), u.x(), u.y(), u.z())};
}

}  // namespace

Vec3 renamed(const Vec3& v, char axis) {
  return axis == 'y' ? Vec3(v.y(), v.z(), v.x()) : axis == 'x' ? Vec3(v.z(), v.x(), v.y()) : v;
}

Configuration renamed(const Configuration& c, char axis) {
  Configuration result{c.a, renamed_pose(c.pose_a, axis), c.b, renamed_pose(c.pose_b, axis)};
  if (const auto* const box = std::get_if<Box>(&c.b)) {
    result.b = Box(renamed(box->half_extents(), axis));
  }
  if (const auto* const plane = std::get_if<Plane>(&c.b)) {
    result.b = Plane(renamed(plane->normal(), axis), plane->displacement());
  }
  return result;
}

Answer answer_in_axis(CandidateProcess& process, const Configuration& c, char axis) {
  if (axis == 'z') return process.answer(c);
  Configuration asked = renamed(c, axis);
  const Eigen::Quaterniond z_to_axis = axis == 'y' ? Eigen::Quaterniond(M_SQRT1_2, -M_SQRT1_2, 0, 0)
                                                   : Eigen::Quaterniond(M_SQRT1_2, 0, M_SQRT1_2, 0);
  const auto turn = [&](Pose& pose) {
    pose = Pose(pose.position(), pose.orientation() * z_to_axis);
  };
  turn(asked.pose_a);
  const Pair pair = pair_of(c);
  if (pair == Pair::cylinder || pair == Pair::capsule) turn(asked.pose_b);
  Answer answer = process.answer(asked);
  const auto back = [axis](double(&v)[3]) {
    const Vec3 u = renamed(Vec3(v[0], v[1], v[2]), axis == 'y' ? 'x' : 'y');
    for (int i = 0; i < 3; ++i) v[i] = u[i];
  };
  back(answer.normal);
  for (int i = 0; i < answer.point_count; ++i) {
    back(answer.points[i].position);
    back(answer.points[i].normal);
  }
  return answer;
}

}  // namespace touchstone
