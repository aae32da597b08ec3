// Which joints of a robot are those of wheels, and rates at which they roll.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/scenes/robot_file.hpp"

namespace touchstone {
namespace {

/// A joint that turns a wheel.
struct Wheel {
  const LinkJoint* joint;
  double radius;  ///< m
};

/// Radius about the joint's axis of a shape that rolls about it: a cylinder or capsule along it, or
/// a sphere in it; zero for others.
double rolling_radius(const LinkShape& shape, const LinkJoint& joint) {
  constexpr double max_sine = 0.02, max_off = 0.05;  // askew, rad; off the axis, of the radius
  const Vec3 axis = joint.axis.normalized();
  double radius = 0;
  bool is_along = true;
  if (const auto* s = std::get_if<Sphere>(&shape.shape)) radius = s->radius();
  if (const auto* c = std::get_if<Cylinder>(&shape.shape)) radius = c->radius();
  if (const auto* c = std::get_if<Capsule>(&shape.shape)) radius = c->radius();
  if (!std::holds_alternative<Sphere>(shape.shape)) {
    is_along = shape.pose.axis().cross(axis).norm() < max_sine;
  }
  const double off = (shape.pose.position() - joint.anchor).cross(axis).norm();
  return is_along && off <= max_off * radius ? radius : 0;
}

/// The wheels of a robot or world: links that turn without limits, by a motor, about an axis that
/// is not upright, as a swivel's or a turntable's is.
std::vector<Wheel> wheels(const RobotFile& robot) {
  std::vector<Wheel> result;
  const Vec3 up = robot.gravity.norm() > 0 ? -robot.gravity.normalized() : Vec3(Vec3::UnitZ());
  for (const LinkJoint& joint : robot.joints) {
    constexpr double max_upright = 0.7;  // cosine
    const bool is_endless = joint.lower < -max_in_world && joint.upper > max_in_world;
    const bool can_roll = joint.kind == JointKind::hinge && is_endless && joint.holds &&
                          !robot.links[joint.child].fixed &&
                          std::abs(joint.axis.normalized().dot(up)) < max_upright;
    if (!can_roll) continue;
    double radius = 0;
    for (const LinkShape& shape : robot.links[joint.child].shapes) {
      radius = std::max(radius, rolling_radius(shape, joint));
    }
    if (radius > 0) result.push_back({&joint, radius});
  }
  return result;
}

}  // namespace

std::vector<std::pair<std::string, double>> rolling_rates(const RobotFile& robot) {
  // One turn of the largest in the usual two seconds: all of its rim comes down once.
  constexpr double rate = std::numbers::pi;  // rad/s
  const std::vector<Wheel> all = wheels(robot);
  double largest = 0;
  for (const Wheel& wheel : all) largest = std::max(largest, wheel.radius);
  std::vector<std::pair<std::string, double>> rates;
  for (const auto& [joint, radius] : all) {
    const double sense = joint->axis.dot(all.front().joint->axis) < 0 ? -1 : 1;
    rates.emplace_back(joint->name, sense * rate * largest / radius);
  }
  return rates;
}

}  // namespace touchstone
