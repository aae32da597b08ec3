#include "properties/motions/critical_pose.hpp"

#include "properties/named.hpp"
#include "properties/turns.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

// All alignments are exact: integer quaternions, and sizes and depth are powers of two.
constexpr double radius = 0.25, half_length = 0.5;
constexpr double depth = 1.0 / 256;

const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), none(0, 0, 0);

Cylinder can() { return Cylinder(radius, half_length); }
Pose at(double px, double py, double pz, const Quaternion& q) { return Pose({px, py, pz}, q); }
Plane ground() { return Plane(z, 0); }

CriticalPose::Change tilt(const char* what, const Vec3& about) { return {what, about, none}; }
CriticalPose::Change offset(const char* what, const Vec3& along) { return {what, none, along}; }

std::vector<CriticalPose> make() {
  // Of a triangle 3-4-5: cos = 0.6, sin = 0.8.
  const Quaternion leaning(2, 0, 1, 0), leaning_back(2, 0, -1, 0);
  const Vec3 outward(0.6, 0, 0.8), along_edge_up(0.8, 0, -0.6);
  const double reach = radius - depth;
  return {
      {"lying",
       "A cylinder lies on a plane: a line of contact.",
       {can(), at(0, 0, radius - depth, along_x), ground(), Pose()},
       tilt("tilt of the axis out of the plane", y),
       tilt("turn on the plane", z)},
      {"standing",
       "A cylinder stands on a plane: a disc of contact.",
       {can(), at(0, 0, half_length - depth, upright), ground(), Pose()},
       tilt("tilt about x", x),
       tilt("tilt about y", y)},
      {"parallel-sides",
       "Two cylinders lie side by side, the axes parallel: a line of contact.",
       {can(), at(0.125, 0, 2 * radius - depth, along_x), can(), at(0, 0, 0, along_x)},
       tilt("tilt in the plane of the axes", y),
       tilt("turn across it", z)},
      {"cap-on-cap",
       "Equal cylinders on top of each other, the axes in line: a full disc of contact.",
       {can(), at(0, 0, 2 * half_length - depth, upright), can(), Pose()},
       tilt("tilt about x", x),
       offset("offset along x", x)},
      {"t",
       "A cylinder's cap stands across another one's side at a right angle: a line of contact.",
       {can(), at(0, 0, half_length + radius - depth, upright), can(), at(0, 0, 0, along_x)},
       tilt("tilt about y, along the other's axis", y),
       tilt("tilt about x, around the other's side", x)},
      {"x",
       "The sides of two cylinders cross at a right angle: a point of contact.",
       {can(), at(0, 0, 2 * radius - depth, along_y), can(), at(0, 0, 0, along_x)},
       tilt("turn away from the right angle", z),
       tilt("tilt about x", x)},
      {"rim-on-rim",
       "Two leaning cylinders meet at their rims, whose tangents there are parallel; two normals "
       "tie.",
       {can(), at(0, 0, 1 - depth, leaning), can(), at(0, 0, 0, leaning_back)},
       offset("offset along x, across the rims", x),
       tilt("turn of the tangents about z", z)},
      {"edge-on-side",
       "A box's edge lies along a cylinder's side, parallel to its axis: a line of contact.",
       {can(), at(0.5 + reach * outward.x(), 0.125, 0.5 + reach * outward.z(), along_y),
        Box({0.5, 0.5, 0.5}), Pose()},
       tilt("tilt out of the tangent plane", along_edge_up),
       tilt("turn in the tangent plane", outward)},
      {"cap-on-box-corner",
       "A cylinder stands on a box's corner, its axis through it: a quarter disc of contact.",
       {can(), at(0.5, 0.5, 0.5 + half_length - depth, upright), Box({0.5, 0.5, 0.5}), Pose()},
       tilt("tilt about x", x),
       tilt("tilt about y", y)},
  };
}

}  // namespace

const std::vector<CriticalPose>& critical_poses() {
  static const std::vector<CriticalPose> poses = make();
  return poses;
}

const CriticalPose& find_critical_pose(std::string_view name) {
  return named(critical_poses(), name, "map.pose");
}

Configuration map_pixel(const CriticalPose& pose, Decade zoom, int column, int row) {
  const double u = zoom.value() * (static_cast<double>(column) / map_reach);
  const double v = zoom.value() * (static_cast<double>(row) / map_reach);
  const double size = smaller_size(pose.configuration);
  const auto sum = [](double s, const Vec3& a, double t, const Vec3& b) {
    return Vec3(s * a.x() + t * b.x(), s * a.y() + t * b.y(), s * a.z() + t * b.z());
  };
  return moved(pose.configuration, sum(u, pose.across.turn, v, pose.up.turn),
               sum(size * u, pose.across.move, size * v, pose.up.move));
}

}  // namespace touchstone
