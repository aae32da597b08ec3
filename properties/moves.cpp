#include "properties/moves.hpp"

#include <vector>

#include "oracle/hull.hpp"

namespace touchstone {
namespace {

Pose turned_in_place(const Pose& pose, const Eigen::Quaterniond& local) {
  return {pose.position(), pose.unit_orientation() * local};
}

struct Scaled {
  double factor;
  Shape operator()(const Cylinder& s) const {
    return Cylinder(factor * s.radius(), factor * s.half_length(), factor * s.rounding());
  }
  Shape operator()(const Capsule& s) const {
    return Capsule(factor * s.radius(), factor * s.half_length());
  }
  Shape operator()(const Sphere& s) const { return Sphere(factor * s.radius()); }
  Shape operator()(const Box& s) const {
    return Box(factor * s.half_extents(), factor * s.rounding());
  }
  Shape operator()(const Convex& s) const {
    std::vector<Vec3> vertices = s.vertices();
    for (Vec3& v : vertices) v *= factor;
    return oracle::convex_hull(vertices,
                               factor * s.rounding());  // rounding may have made other faces
  }
  Shape operator()(const Plane& s) const { return Plane(s.normal(), factor * s.displacement()); }
};

}  // namespace

bool is_round(const Shape& shape) {
  return !std::holds_alternative<Box>(shape) && !std::holds_alternative<Plane>(shape) &&
         !std::holds_alternative<Convex>(shape);
}

Configuration exchanged(const Configuration& c) {
  return {std::get<Cylinder>(c.b), c.pose_b, c.a, c.pose_a};
}

Configuration rotated(const Configuration& c, const Eigen::Quaterniond& turn) {
  const auto moved = [&](const Pose& pose) {
    return Pose(turn * pose.position(), turn * pose.unit_orientation());
  };
  return {c.a, moved(c.pose_a), c.b, moved(c.pose_b)};
}

Configuration translated(const Configuration& c, const Vec3& by) {
  const auto moved = [&](const Pose& pose) {
    return Pose(pose.position() + by, pose.orientation());
  };
  return {c.a, moved(c.pose_a), c.b, moved(c.pose_b)};
}

Configuration with_a_moved(const Configuration& c, const Vec3& by) {
  return {c.a, Pose(c.pose_a.position() + by, c.pose_a.orientation()), c.b, c.pose_b};
}

Configuration spun(const Configuration& c, double angle) {
  const Eigen::Quaterniond spin(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  return {c.a, turned_in_place(c.pose_a, spin), c.b,
          is_round(c.b) ? turned_in_place(c.pose_b, spin) : c.pose_b};
}

Configuration flipped(const Configuration& c) {
  const Eigen::Quaterniond half_turn(0, 1, 0, 0);
  return {c.a, turned_in_place(c.pose_a, half_turn), c.b,
          std::holds_alternative<Plane>(c.b) || std::holds_alternative<Convex>(c.b)
              ? c.pose_b
              : turned_in_place(c.pose_b, half_turn)};
}

Shape scaled(const Shape& shape, double factor) { return std::visit(Scaled{factor}, shape); }

Configuration scaled(const Configuration& c, double factor) {
  const auto moved = [&](const Pose& pose) {
    return Pose(factor * pose.position(), pose.orientation());
  };
  return {std::get<Cylinder>(Scaled{factor}(c.a)), moved(c.pose_a), scaled(c.b, factor),
          moved(c.pose_b)};
}

Configuration with_a_grown(const Configuration& c, double radius, double half_length) {
  const Cylinder& a = c.a;
  return {Cylinder(radius * a.radius(), half_length * a.half_length(), a.rounding()), c.pose_a, c.b,
          c.pose_b};
}

}  // namespace touchstone
