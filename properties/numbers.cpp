#include "properties/numbers.hpp"

#include <cmath>
#include <initializer_list>

#include "oracle/hull.hpp"
#include "properties/draw.hpp"

namespace touchstone {
namespace {

Shape body_b(const Numbers& n) {
  const auto& s = n.sizes;
  switch (n.pair) {
    case Pair::plane:
      return Plane(n.normal, n.displacement);
    case Pair::sphere:
      return Sphere(s[2]);
    case Pair::capsule:
      return Capsule(s[2], s[3]);
    case Pair::cylinder:
      return Cylinder(s[2], s[3], n.rounding_b);
    case Pair::convex:
      return oracle::convex_hull(n.vertices, n.rounding_b);
    case Pair::box:
      break;
  }
  return Box({s[2], s[3], s[4]}, n.rounding_b);
}

}  // namespace

std::size_t size_count(Pair pair) {
  switch (pair) {
    case Pair::plane:
    case Pair::convex:
      return 2;
    case Pair::sphere:
      return 3;
    case Pair::capsule:
    case Pair::cylinder:
      return 4;
    case Pair::box:
      break;
  }
  return 5;
}

Numbers numbers_of(const Configuration& c) {
  Numbers n;
  n.pair = pair_of(c);
  n.position_a = c.pose_a.position();
  n.position_b = c.pose_b.position();
  n.orientation_a = c.pose_a.orientation();
  n.orientation_b = c.pose_b.orientation();
  n.rounding_a = c.a.rounding();
  n.rounding_b = rounding_of(c.b);
  const auto add = [&](std::initializer_list<double> sizes) {
    n.sizes.insert(n.sizes.end(), sizes);
  };
  add({c.a.radius(), c.a.half_length()});
  if (const auto* sphere = std::get_if<Sphere>(&c.b)) add({sphere->radius()});
  if (const auto* s = std::get_if<Capsule>(&c.b)) add({s->radius(), s->half_length()});
  if (const auto* s = std::get_if<Cylinder>(&c.b)) add({s->radius(), s->half_length()});
  if (const auto* s = std::get_if<Box>(&c.b)) {
    add({s->half_extents().x(), s->half_extents().y(), s->half_extents().z()});
  }
  if (const auto* s = std::get_if<Convex>(&c.b)) n.vertices = s->vertices();
  if (const auto* s = std::get_if<Plane>(&c.b)) {
    n.normal = s->normal();
    n.displacement = s->displacement();
  }
  return n;
}

Configuration configuration_of(const Numbers& n) {
  return {Cylinder(n.sizes[0], n.sizes[1], n.rounding_a), Pose(n.position_a, n.orientation_a),
          body_b(n), Pose(n.position_b, n.orientation_b)};
}

std::vector<double*> every_number(Numbers& n) {
  std::vector<double*> all;
  const auto add_vector = [&](Vec3& v) { all.insert(all.end(), {&v.x(), &v.y(), &v.z()}); };
  const auto add_pose = [&](Vec3& position, Eigen::Quaterniond& q) {
    add_vector(position);
    all.insert(all.end(), {&q.w(), &q.x(), &q.y(), &q.z()});
  };
  const auto add_rounding = [&](double& rounding) {
    if (rounding > 0) all.push_back(&rounding);
  };
  all.insert(all.end(), {&n.sizes[0], &n.sizes[1]});
  add_rounding(n.rounding_a);
  add_pose(n.position_a, n.orientation_a);
  for (std::size_t i = 2; i < n.sizes.size(); ++i) all.push_back(&n.sizes[i]);
  for (Vec3& vertex : n.vertices) add_vector(vertex);
  add_rounding(n.rounding_b);
  if (n.pair == Pair::plane) {
    add_vector(n.normal);
    all.push_back(&n.displacement);
  }
  add_pose(n.position_b, n.orientation_b);
  return all;
}

void turn_both(Numbers& n, const Eigen::Quaterniond& by) {
  n.position_a = rotated(by, n.position_a);
  n.position_b = rotated(by, n.position_b);
  n.orientation_a = product(by, n.orientation_a);
  n.orientation_b = product(by, n.orientation_b);
}

void scale_both(Numbers& n, int exponent) {
  const auto scaled = [&](double& x) { x = std::ldexp(x, exponent); };
  for (double& size : n.sizes) scaled(size);
  for (Vec3& vertex : n.vertices) {
    for (int i = 0; i < 3; ++i) scaled(vertex[i]);
  }
  for (int i = 0; i < 3; ++i) scaled(n.position_a[i]), scaled(n.position_b[i]);
  scaled(n.displacement);
  scaled(n.rounding_a);
  scaled(n.rounding_b);
}

}  // namespace touchstone
