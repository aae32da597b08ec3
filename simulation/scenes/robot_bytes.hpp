#pragma once

#include "properties/files/bytes.hpp"
#include "simulation/scenes/robot_file.hpp"

// A robot on its way from the process that reads it.
namespace touchstone {

template <>
inline LinkShape blank<LinkShape>() {
  return {"", Sphere(1), Pose()};
}
template <class Archive>
void members(Archive& a, LinkShape& x) {
  a(x.name, x.shape, x.pose, x.friction, x.mask);
}
template <class Archive>
void members(Archive& a, LinkInertia& x) {
  a(x.pose, x.moments);
}
template <class Archive>
void members(Archive& a, Link& x) {
  a(x.name, x.pose, x.shapes, x.mass, x.inertia, x.fixed);
}
template <class Archive>
void members(Archive& a, LinkJoint& x) {
  a(x.name, x.kind, x.child, x.parent, x.anchor, x.axis, x.lower, x.upper, x.effort, x.holds);
}
template <class Archive>
void members(Archive& a, RobotFile& x) {
  a(x.name, x.links, x.joints, x.apart, x.is_world, x.gravity, x.step, x.left_out, x.ignored);
}

}  // namespace touchstone
