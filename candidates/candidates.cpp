#include "candidates/candidates.hpp"

#include <algorithm>
#include <string>

#include "candidates/entry_points.h"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

void release_nothing(ts_prepared*) {}

struct ToTsShape {
  ts_shape operator()(const Cylinder& s) const {
    return {TS_CYLINDER, {s.radius(), s.half_length()}};
  }
  ts_shape operator()(const Plane& s) const {
    const double length = s.normal().norm();
    const Vec3 n = s.normal() / length;
    return {TS_PLANE, {n.x(), n.y(), n.z(), s.displacement() / length}};
  }
  ts_shape operator()(const Sphere& s) const { return {TS_SPHERE, {s.radius()}}; }
  ts_shape operator()(const Capsule& s) const {
    return {TS_CAPSULE, {s.radius(), s.half_length()}};
  }
  ts_shape operator()(const Box& s) const {
    const Vec3& h = s.half_extents();
    return {TS_BOX, {h.x(), h.y(), h.z()}};
  }
};

}  // namespace

std::span<const ts_candidate* const> all_candidates() {
  static const ts_candidate* const candidates[] = {touchstone_reference(), touchstone_bullet(),
                                                   touchstone_ode()};
  return candidates;
}

const ts_candidate& find_candidate(std::string_view name) {
  std::string names;
  for (const ts_candidate* candidate : all_candidates()) {
    if (candidate->name == name) return *candidate;
    names += (names.empty() ? "" : ", ") + std::string(candidate->name);
  }
  throw InvalidInput("--candidates", '"' + std::string(name) + '"', "must be one of " + names);
}

ts_shape to_ts_shape(const Shape& shape) { return std::visit(ToTsShape{}, shape); }

ts_pose to_ts_pose(const Pose& pose) {
  const Vec3& p = pose.position();
  const Eigen::Quaterniond q = pose.orientation().normalized();
  return {{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

PreparedPair::PreparedPair(const ts_candidate& candidate, const Cylinder& a, const Shape& b,
                           double threshold)
    : candidate_(&candidate), prepared_(nullptr, release_nothing) {
  const ts_shape shape_a = to_ts_shape(a), shape_b = to_ts_shape(b);
  if (!candidate.supports(shape_b.kind)) return;
  prepared_ = {candidate.prepare(&shape_a, &shape_b, threshold), candidate.release};
}

ts_answer PreparedPair::query(const ts_pose& a, const ts_pose& b) const {
  ts_answer answer{};
  if (!prepared_) {
    answer.status = TS_UNSUPPORTED;
    return answer;
  }
  candidate_->query(prepared_.get(), &a, &b, &answer);
  if (answer.point_count < 0 || answer.point_count > TOUCHSTONE_MAX_POINTS) {
    answer = {};
    answer.status = TS_FAILED;
  }
  return answer;
}

ts_answer answer(const ts_candidate& candidate, const Configuration& configuration,
                 double threshold) {
  const PreparedPair pair(candidate, configuration.a, configuration.b, threshold);
  return pair.query(to_ts_pose(configuration.pose_a), to_ts_pose(configuration.pose_b));
}

}  // namespace touchstone
