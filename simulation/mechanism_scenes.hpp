#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "reference/invalid_input.hpp"
#include "simulation/scene.hpp"

// Bodies, joints and scenes for the tests of mechanisms, in our own world and in the engines'.

namespace touchstone {

inline Pose at(double x, double y, double z) { return Pose(Vec3(x, y, z)); }
inline Body box(const char* name, const Vec3& half_extents, const Pose& pose) {
  return {.name = name, .shape = Box(half_extents), .pose = pose};
}
inline Body fixed(Body body) {
  body.fixed = true;
  return body;
}
inline Joint hinge(int a, int b, const Vec3& anchor, const Vec3& axis) {
  return {"hinge", JointKind::hinge, a, b, anchor, axis};
}
inline Joint rigid(int a, int b) { return {"rigid", JointKind::fixed, a, b}; }
inline Motor rate(double target, double force) {
  return {Motor::Target::rate, {{0, target}}, force};
}
/// Reaches its position after half a second.
inline Motor position(double target, double force) {
  return {Motor::Target::position, {{0, 0}, {0.5, target}}, force};
}

/// What check_scene says of a scene.
inline std::string refusal_of(const Scene& scene) {
  try {
    check_scene(scene);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "accepted";
}

/// Right-handed angle about z, −π … π.
inline double angle_about_z(const Pose& pose) {
  return std::atan2(pose.rotation()(1, 0), pose.rotation()(0, 0));
}

/// Limits of a hinge, rad, that no engine holds by the angle within a turn alone; also without one
/// of them.
inline const std::vector<std::pair<double, double>> far_limits = {
    {-0.0175, 3.75},
    {-std::numbers::pi, std::numbers::pi},
    {-3, 3.2},
    {-4, 7.5},
    {-std::numeric_limits<double>::infinity(), 3.5},
    {-6.5, std::numeric_limits<double>::infinity()}};

/// Where a motor that turns a hinge by this angle leaves it.
inline double turned_within(const std::pair<double, double>& limits, double angle) {
  return std::clamp(angle, limits.first, limits.second);
}

/// A box lies on a driven drum that turns about y by 4.2 rad in a step, so that friction drags it
/// along x.
inline Scene fast_drum() {
  Scene scene;
  scene.duration = 0.1;
  Body drum{.name = "drum", .shape = Cylinder(1, 1)};
  drum.pose = Pose(Vec3::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(1.5707963, Vec3::UnitX())));
  drum.drive = SteadyMotion{.angular_velocity = Vec3(0, 1000, 0)};
  scene.bodies = {drum, box("brick", Vec3(0.1, 0.1, 0.05), at(0, 0, 1.05 - 1e-5))};
  return scene;
}

/// A box that tumbles freely, and the same box of two halves that a fixed joint connects.
struct TumblingBox {
  Scene halves, whole;

  TumblingBox() {
    halves.gravity = whole.gravity = Vec3::Zero();
    const Vec3 v(0.2, 0, 0.1), w(1, 2, 3);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 centre(side * 0.3, 0, 0);
      halves.bodies.push_back(box(side < 0 ? "left" : "right", Vec3(0.3, 0.2, 0.1), Pose(centre)));
      halves.bodies.back().velocity = v + w.cross(centre);
      halves.bodies.back().angular_velocity = w;
    }
    halves.joints = {rigid(0, 1)};
    whole.bodies = {box("whole", Vec3(0.6, 0.2, 0.1), Pose())};
    whole.bodies[0].velocity = v;
    whole.bodies[0].angular_velocity = w;
  }
};

}  // namespace touchstone
