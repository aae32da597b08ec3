#include "candidates/model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchstone {
namespace {

std::vector<RoundedPolytope> parts(const ts_shape& shape, const CylinderModel& model) {
  const double* s = shape.size;
  switch (shape.kind) {
    case TS_CYLINDER:
      return model(s[0], s[1]);
    case TS_SPHERE:
      return {RoundedPolytope::sphere(Vec3::Zero(), s[0])};
    case TS_CAPSULE:
      return {RoundedPolytope::capsule(s[0], s[1])};
    case TS_BOX:
      return {RoundedPolytope::box(Vec3(s[0], s[1], s[2]))};
    case TS_PLANE:
      return {};
  }
  return {};
}

}  // namespace

ModelPair::ModelPair(const ts_shape& a, const ts_shape& b, const CylinderModel& model)
    : a_(parts(a, model)), b_(parts(b, model)), plane_(b), is_plane_(b.kind == TS_PLANE) {}

Separation ModelPair::separation(const ts_pose& a, const ts_pose& b, std::vector<Separation>* all) {
  const Eigen::Matrix3d rotation_b = rotation_of(b);
  for (RoundedPolytope& part : a_) part.place(rotation_of(a), position_of(a));
  for (RoundedPolytope& part : b_) part.place(rotation_b, position_of(b));
  const Vec3 normal = rotation_b * Vec3(plane_.size[0], plane_.size[1], plane_.size[2]);
  const double displacement = plane_.size[3] + normal.dot(position_of(b));

  Separation least{};
  for (std::size_t i = 0; i < a_.size(); ++i) {
    Separation of_part{};
    if (is_plane_) {
      of_part = touchstone::separation(a_[i], normal, displacement);
    } else {
      for (std::size_t j = 0; j < b_.size(); ++j) {
        const Separation s = touchstone::separation(a_[i], b_[j]);
        if (j == 0 || s.distance < of_part.distance) of_part = s;
      }
    }
    if (all) all->push_back(of_part);
    if (i == 0 || of_part.distance < least.distance) least = of_part;
  }
  return least;
}

std::vector<RoundedPolytope> inscribed_capsule(double radius, double half_length) {
  const double r = std::min(radius, half_length);
  return {RoundedPolytope::capsule(r, half_length - r)};
}

std::vector<RoundedPolytope> circumscribed_capsule(double radius, double half_length) {
  return {RoundedPolytope::capsule(radius, half_length)};
}

std::vector<RoundedPolytope> inscribed_spheres(int count, double radius, double half_length) {
  const double r = std::min(radius, half_length);
  std::vector<RoundedPolytope> result;
  for (int i = 0; i < count; ++i) {
    Vec3 centre = Vec3::Zero();
    if (half_length >= radius) {
      if (count > 1) centre.z() = (half_length - r) * (2.0 * i / (count - 1) - 1);
    } else if (count > 1) {
      const double angle = 2 * std::numbers::pi * i / count;
      centre = (radius - r) * Vec3(std::cos(angle), std::sin(angle), 0);
    }
    result.push_back(RoundedPolytope::sphere(centre, r));
  }
  return result;
}

std::vector<RoundedPolytope> inscribed_prism(int sides, double radius, double half_length) {
  return {RoundedPolytope::prism(sides, radius, half_length)};
}

}  // namespace touchstone
