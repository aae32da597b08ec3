#include "properties/features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "properties/moves.hpp"

namespace touchstone {
namespace {

/// Fraction of a feature's extent within which contact is made; the outer tenth is left to the rim
/// classes.
constexpr double inner = 0.9;

Vec3 in_world(const Axes& a, const Vec3& local) {
  return local.x() * a.x + local.y() * a.y + local.z() * a.z;
}
Vec3 in_body(const Axes& a, const Vec3& world) {
  return Vec3(dot(a.x, world), dot(a.y, world), dot(a.z, world));
}

/// A point of a round body (radius, half length along z) at which the local direction n is an
/// outward normal.
Vec3 point_on_round(Draw& draw, double radius, double half_length, Feature feature, const Vec3& n) {
  const double z = feature == Feature::side ? half_length * draw.uniform(-inner, inner)
                                            : std::copysign(half_length, n.z());
  if (feature == Feature::cap) {
    double x, y;
    do {
      x = draw.uniform(-1, 1);
      y = draw.uniform(-1, 1);
    } while (x * x + y * y > 1);
    return Vec3(inner * radius * x, inner * radius * y, z);
  }
  const double across = std::sqrt(n.x() * n.x() + n.y() * n.y());
  return across > 0 ? Vec3(radius * n.x() / across, radius * n.y() / across, z)
                    : Vec3(radius, 0, z);
}

/// Index of the axis nearest to a direction.
int nearest_axis(const Vec3& local) {
  int best = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(local[i]) > std::abs(local[best])) best = i;
  }
  return best;
}

Vec3 point_on_box(Draw& draw, const Vec3& half, Feature feature, const Vec3& n, int edge) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) {
    const bool along = (feature == Feature::edge && i == edge) ||
                       (feature == Feature::cap && i != nearest_axis(n));
    p[i] = along ? half[i] * draw.uniform(-inner, inner) : std::copysign(half[i], n[i]);
  }
  return p;
}

struct PointOnB {
  Draw& draw;
  Feature feature;
  const Axes& axes;
  const Vec3& n;  // world, towards A
  int edge;

  Vec3 operator()(const Cylinder& s) const {
    return in_world(axes,
                    point_on_round(draw, s.radius(), s.half_length(), feature, in_body(axes, n)));
  }
  Vec3 operator()(const Capsule& s) const {
    const Feature part = feature == Feature::side ? Feature::side : Feature::rim;
    return in_world(axes, point_on_round(draw, 0, s.half_length(), part, in_body(axes, n))) +
           s.radius() * n;
  }
  Vec3 operator()(const Sphere& s) const { return s.radius() * n; }
  Vec3 operator()(const Box& s) const {
    return in_world(axes, point_on_box(draw, s.half_extents(), feature, in_body(axes, n), edge));
  }
  Vec3 operator()(const Convex&) const { throw std::logic_error("no features of a hull"); }
  Vec3 operator()(const Plane& s) const {
    // n is the plane's unit normal here.
    const double length = std::sqrt(dot(s.normal(), s.normal()));
    const Vec3 e = draw.direction_across(n);
    return (s.displacement() / length) * n + draw.uniform(-1, 1) * e;
  }
};

Vec3 box_axis(const Axes& a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }

/// The normals of a feature: a single one, all perpendicular to a line, or any.
struct Directions {
  enum Kind { one, across, any } kind;
  Vec3 axis;
};

Directions directions_of_a(Draw& draw, const Axes& axes, Feature feature) {
  if (feature == Feature::cap) return {Directions::one, draw.sign() * axes.z};
  if (feature == Feature::side) return {Directions::across, axes.z};
  return {Directions::any, axes.z};
}

Directions directions_of_b(Draw& draw, const Bodies& bodies, const Axes& axes, Feature feature,
                           int edge) {
  if (const auto* plane = std::get_if<Plane>(&bodies.b)) {
    return {Directions::one, normalized(in_world(axes, plane->normal()))};
  }
  if (std::holds_alternative<Box>(bodies.b)) {
    if (feature == Feature::cap) return {Directions::one, draw.sign() * box_axis(axes, edge)};
    if (feature == Feature::edge) return {Directions::across, box_axis(axes, edge)};
    return {Directions::any, axes.z};
  }
  return directions_of_a(draw, axes, feature);
}

/// The common normal, towards A. A plane's normal has priority, then that of A's cap, then that of
/// B's face.
Vec3 common_normal(Draw& draw, const Directions& a, const Directions& b, bool b_is_plane) {
  if (b_is_plane) return b.axis;
  if (a.kind == Directions::one) return a.axis;
  if (b.kind == Directions::one) return b.axis;
  if (a.kind == Directions::across && b.kind == Directions::across) {
    const Vec3 n = cross(a.axis, b.axis);
    if (dot(n, n) > 0) return draw.sign() * normalized(n);
  }
  if (a.kind == Directions::across) return draw.direction_across(a.axis);
  if (b.kind == Directions::across) return draw.direction_across(b.axis);
  return draw.direction();
}

}  // namespace

Cylinder draw_cylinder(Draw& draw) {
  const double radius = draw.log_uniform(0.2, 1);
  return Cylinder(radius, draw.log_uniform(0.2, 1));
}

Shape draw_other(Draw& draw, Pair pair) {
  const auto size = [&] { return draw.log_uniform(0.2, 1); };
  switch (pair) {
    case Pair::plane: {
      const Vec3 normal = draw.direction();
      return Plane(normal, draw.uniform(-1, 1));
    }
    case Pair::sphere:
      return Sphere(size());
    case Pair::capsule: {
      const double radius = size();
      return Capsule(radius, size());
    }
    case Pair::cylinder:
      return draw_cylinder(draw);
    case Pair::box: {
      const double x = size(), y = size(), z = size();
      return Box(Vec3(x, y, z));
    }
    case Pair::convex:
      break;
  }
  throw std::logic_error("no such pair");
}

namespace {

template <class Round>
Round formed(Form form, double size) {
  const double small = size / static_cast<double>(extreme_ratio);
  return form == Form::needle ? Round(small, size) : Round(size, small);
}

void reshape(Draw& draw, Proportions proportions, Bodies& bodies) {
  const Forms form = forms(proportions);
  if (form.a != Form::usual) bodies.a = formed<Cylinder>(form.a, bodies.a.radius());
  if (form.b != Form::usual) {
    if (const auto* s = std::get_if<Capsule>(&bodies.b)) {
      bodies.b = formed<Capsule>(form.b, s->radius());
    } else {
      bodies.b = formed<Cylinder>(form.b, std::get<Cylinder>(bodies.b).radius());
    }
  }
  if (proportions == Proportions::plate) {
    const std::array<bool, 3> is_thin = draw_thin_extents(draw);
    const double length = std::get<Box>(bodies.b).half_extents().x();
    const auto extent = [&](std::size_t i) {
      return is_thin[i] ? length / static_cast<double>(extreme_ratio) : length;
    };
    bodies.b = Box(Vec3(extent(0), extent(1), extent(2)));
  } else if (proportions == Proportions::uneven) {
    const double factor = 1 / static_cast<double>(draw_uneven_ratio(draw));
    if (draw.coin()) {
      bodies.a = std::get<Cylinder>(scaled(Shape(bodies.a), factor));
    } else {
      bodies.b = scaled(bodies.b, factor);
    }
  }
}

}  // namespace

Bodies draw_bodies(Draw& draw, Pair pair, Proportions proportions) {
  const Cylinder a = draw_cylinder(draw);
  const Eigen::Quaterniond orientation_a = draw.orientation();
  const Shape b = draw_other(draw, pair);
  Bodies bodies{a, orientation_a, b, draw.orientation()};
  reshape(draw, proportions, bodies);
  return bodies;
}

double smaller_size(const Bodies& bodies) {
  return std::min(smallest_half_extent(bodies.a), smallest_half_extent(bodies.b));
}

Configuration meet(Draw& draw, const Bodies& bodies, Feature on_a, Feature on_b, double distance) {
  const int axis = static_cast<int>(draw.integer(0, 2));
  return meet_at(draw, bodies, on_a, on_b, distance, axis);
}

Configuration meet_at(Draw& draw, const Bodies& bodies, Feature on_a, Feature on_b, double distance,
                      int edge) {
  const Axes axes_a = axes(bodies.orientation_a), axes_b = axes(bodies.orientation_b);
  const Directions of_a = directions_of_a(draw, axes_a, on_a);
  const Directions of_b = directions_of_b(draw, bodies, axes_b, on_b, edge);
  const bool b_is_plane = std::holds_alternative<Plane>(bodies.b);
  const Vec3 n = common_normal(draw, of_a, of_b, b_is_plane);

  const Vec3 point_a =
      in_world(axes_a, point_on_round(draw, bodies.a.radius(), bodies.a.half_length(), on_a,
                                      in_body(axes_a, Vec3(-n))));
  const Vec3 point_b = std::visit(PointOnB{draw, on_b, axes_b, n, edge}, bodies.b);
  const Vec3 centre_b{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
  return {bodies.a, Pose(centre_b + ((point_b - point_a) + distance * n), bodies.orientation_a),
          bodies.b, Pose(centre_b, bodies.orientation_b)};
}

Configuration overlap_deeply(Draw& draw, const Bodies& bodies, Proportions proportions) {
  if (std::holds_alternative<Plane>(bodies.b)) {
    const double distance = -bodies.a.half_length() * draw.uniform(0.1, 2);
    return meet(draw, bodies, Feature::rim, Feature::cap, distance);
  }
  const bool thin_a = proportions == Proportions::needle || proportions == Proportions::coin;
  const double max_distance = thin_a ? smallest_half_extent(bodies.b) : smaller_size(bodies);
  const Vec3 centre_b{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
  const double distance = max_distance * draw.uniform(0, 1);
  const Vec3 centre_a = centre_b + distance * draw.direction();
  return {bodies.a, Pose(centre_a, bodies.orientation_a), bodies.b,
          Pose(centre_b, bodies.orientation_b)};
}

FeaturePair draw_feature_pair(Draw& draw, Pair pair) {
  using enum Feature;
  static const std::vector<FeaturePair> plane = {{rim, cap}};
  static const std::vector<FeaturePair> sphere = {{cap, end}, {side, end}};
  static const std::vector<FeaturePair> capsule = {
      {cap, end}, {side, end}, {side, side}, {rim, side}};
  static const std::vector<FeaturePair> cylinder = {{cap, rim}, {side, rim}, {side, side},
                                                    {rim, cap}, {rim, side}, {rim, rim}};
  static const std::vector<FeaturePair> box = {
      {cap, vertex}, {rim, cap}, {side, edge}, {rim, edge}, {side, vertex}};
  const auto& pairs = pair == Pair::plane      ? plane
                      : pair == Pair::sphere   ? sphere
                      : pair == Pair::capsule  ? capsule
                      : pair == Pair::cylinder ? cylinder
                                               : box;
  return pairs[static_cast<std::size_t>(
      draw.integer(0, static_cast<std::int64_t>(pairs.size()) - 1))];
}

namespace {

using Quaternion = Eigen::Quaterniond;

/// A rotation away from an alignment by up to half a radian, about an axis near or far from those
/// of B.
Quaternion draw_clear_tilt(Draw& draw) {
  const Quaternion bases[] = {Quaternion(1, 0, 0, 0), Quaternion(1, 1, 0, 0)};
  const Quaternion quarters[] = {Quaternion(1, 0, 0, 0), Quaternion(1, 0, 0, 1)};
  const double half_angle = draw.sign() * draw.log_uniform(1e-7, 0.5) / 2;
  Quaternion heading = draw.turn_about_z();
  if (draw.coin()) {
    const double off = draw.log_uniform(1e-6, 0.5);
    heading = product(draw.any_of(quarters), Quaternion(1, 0, 0, off));
  }
  return product(product(heading, draw.any_of(bases)), Quaternion(1, half_angle, 0, 0));
}

/// Three coordinates in B's frame, each uniform within the bodies' reach, or near a coincidence of
/// their sizes.
Vec3 draw_offset_within(Draw& draw, const std::vector<double>& sizes) {
  const double reach = *std::max_element(sizes.begin(), sizes.end());
  const double part = draw.coin() ? 2 : draw.log_uniform(0.02, 2);
  Vec3 offset = Vec3::Zero();
  const bool coincides = draw.one_in(3);
  for (int i = 0; i < 3; ++i) {
    offset[i] = reach * part * draw.uniform(-1, 1);
    if (coincides && draw.coin()) {
      const double one = draw.any_of(sizes), other = draw.any_of(sizes);
      const double sum = draw.sign() * (one + draw.sign() * other);
      offset[i] = sum + draw.sign() * one * draw.log_uniform(1e-6, 0.5);
    }
  }
  return offset;
}

/// Parallel axes, caps that overlap by little, axes 1e-7 to 0.1 of a radius apart: here contact
/// points change from one layout to another.
void put_caps_together(Draw& draw, Numbers& n) {
  if (draw.coin()) n.sizes[2] = n.sizes[0];
  const double across = n.sizes[0] * draw.log_uniform(1e-7, 0.1);
  const double along = n.sizes[1] + n.sizes[3] - draw_shallow(draw, n.sizes[0]);
  n.orientation_a = n.orientation_b = Quaternion(1, 0, 0, 0);
  n.position_a = n.position_b + Vec3(across, 0, draw.sign() * along);
}

/// Parallel axes with nearly equal depths along and across B's axis: rounding, or a tilt, decides
/// which is smaller.
void make_depths_alike(Draw& draw, Numbers& n) {
  const double across = n.sizes[0] * draw.uniform(0, 2);
  const double depth = n.sizes[0] + n.sizes[2] - across;
  const double half_b = n.sizes.back();  // a box's along z; a capsule's end is a radius farther out
  const double cap_b = n.pair == Pair::capsule ? half_b + n.sizes[2] : half_b;
  const double along =
      n.sizes[1] + cap_b - depth + draw.sign() * n.sizes[0] * draw.log_uniform(1e-6, 0.1);
  n.position_a = n.position_b + across * draw.direction_across(Vec3(0, 0, 1));
  n.position_a.z() += draw.sign() * along;
}

/// Sides that cross close to the end of one of them, nearly at a right angle.
void cross_at_an_end(Draw& draw, Numbers& n) {
  const double quarter = draw.uniform(0.1, 1), lean = draw.log_uniform(1e-7, 1e-2);
  n.orientation_a = product(Quaternion(1, quarter, 0, 0), Quaternion(1, 0, draw.sign() * lean, 0));
  const Vec3 axis = rotated(n.orientation_a, Vec3(0, 0, 1));
  const double on_a = n.sizes[1] * (1 + draw.sign() * draw.log_uniform(1e-7, 1e-2));
  const double on_b = n.sizes[3] * draw.uniform(-1, 1);
  const double across = n.sizes[0] + n.sizes[2] - draw_shallow(draw, n.sizes[0]);
  n.position_a = n.position_b + Vec3(across, 0, on_b) - draw.sign() * on_a * axis;
}

}  // namespace

Numbers draw_entangled(Draw& draw, Pair pair) {
  Numbers n;
  n.pair = pair;
  n.sizes.resize(size_count(pair));
  for (double& size : n.sizes) size = draw.log_uniform(0.05, 2);
  if (pair == Pair::plane) {
    n.normal = Vec3(0, 0, 1);
    n.displacement = draw.uniform(-1, 1);
  }
  n.orientation_a = draw.one_in(4) ? draw.orientation() : draw_clear_tilt(draw);
  n.position_a = draw_offset_within(draw, n.sizes);
  if (pair != Pair::plane && draw.one_in(4)) make_depths_alike(draw, n);
  const bool has_sides = pair == Pair::capsule || pair == Pair::cylinder;
  if (has_sides && draw.one_in(4)) cross_at_an_end(draw, n);
  if (pair == Pair::cylinder && draw.one_in(4)) put_caps_together(draw, n);
  if (draw.one_in(4)) scale_both(n, static_cast<int>(draw.integer(-12, 12)));
  return n;
}

}  // namespace touchstone
