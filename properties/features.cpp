#include "properties/features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "oracle/hull.hpp"
#include "properties/hulls.hpp"
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

/// The direction of v, or the other one where v's square is no ordinary double.
Vec3 direction_of(const Vec3& v, const Vec3& otherwise) {
  constexpr double smallest = 1e-250, largest = 1e250;
  const double squared = dot(v, v);
  return squared > smallest && squared < largest ? normalized(v) : otherwise;
}

/// Like the face's own normal, but of the same bits on every machine.
Vec3 outward_normal(const Convex& hull, int face) {
  const auto vertex = [&](int i) { return hull.vertices()[static_cast<std::size_t>(i)]; };
  const Convex::Face& f = hull.faces()[static_cast<std::size_t>(face)];
  const Vec3 first = vertex(f.vertices[0]);
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 2; i < f.vertices.size(); ++i) {
    area += cross(vertex(f.vertices[i - 1]) - first, vertex(f.vertices[i]) - first);
  }
  return direction_of(area, f.normal);
}

/// An edge of a hull with one of its outward normals: between those of its faces or, in the plane
/// of a flat one, on one side of it.
EdgeOfHull normal_of_edge(Draw& draw, const Convex& hull, int number) {
  const Convex::Edge& edge = hull.edges()[static_cast<std::size_t>(number)];
  const Vec3 from = hull.vertices()[static_cast<std::size_t>(edge.vertices[0])];
  const Vec3 to = hull.vertices()[static_cast<std::size_t>(edge.vertices[1])];
  const Vec3 along = direction_of(to - from, Vec3(0, 0, 1));
  const Vec3 first = outward_normal(hull, edge.faces[0]);
  const double part = draw.uniform(-inner, inner);
  const Vec3 normal =
      hull.is_flat() ? Vec3(part * first + (1 - std::abs(part)) * cross(along, first))
                     : Vec3((1 + part) * first + (1 - part) * outward_normal(hull, edge.faces[1]));
  return {number, along, direction_of(normal, first)};
}

/// A hull as it lies in the world.
struct PlacedHull {
  const Convex& hull;
  const Axes& axes;

  /// A direction of the world in the hull's frame.
  Vec3 local(const Vec3& n) const { return in_body(axes, n); }

  /// Whether none of the hull's vertices lies farther along a direction of its frame than these,
  /// but for rounding.
  bool is_supported_by(const std::vector<int>& vertices, const Vec3& n) const {
    constexpr double rounding = 1e-9;
    double least = std::numeric_limits<double>::infinity();
    for (const int i : vertices) {
      least = std::min(least, dot(n, hull.vertices()[static_cast<std::size_t>(i)]));
    }
    const double size = hull.half_extents().maxCoeff();
    return dot(n, farthest(n)) <= least + rounding * size;
  }
  /// The vertex that lies farthest along a direction of its frame.
  const Vec3& farthest(const Vec3& n) const {
    return *std::max_element(hull.vertices().begin(), hull.vertices().end(),
                             [&](const Vec3& p, const Vec3& q) { return dot(n, p) < dot(n, q); });
  }
  std::vector<int> vertices_of(Feature feature, int which) const {
    const auto i = static_cast<std::size_t>(which);
    if (feature == Feature::cap) return hull.faces()[i].vertices;
    if (feature == Feature::edge) {
      return {hull.edges()[i].vertices.begin(), hull.edges()[i].vertices.end()};
    }
    return {};
  }
};

/// A random point of the feature where it lies farthest along n; else the vertex that does. World.
Vec3 point_on_hull(Draw& draw, const PlacedHull& b, Feature feature, const Vec3& n, int which) {
  const Vec3 local = b.local(n);
  const std::vector<int> vertices = b.vertices_of(feature, which);
  if (vertices.empty() || !b.is_supported_by(vertices, local)) {
    return in_world(b.axes, b.farthest(local));
  }
  Vec3 middle = Vec3::Zero(), point = Vec3::Zero();
  double sum = 0;
  for (const int i : vertices) {
    const Vec3& vertex = b.hull.vertices()[static_cast<std::size_t>(i)];
    const double weight = draw.uniform(0, 1);
    point += weight * vertex;
    sum += weight;
    middle += vertex;
  }
  middle /= static_cast<double>(vertices.size());
  if (sum > 0) middle += inner * (point / sum - middle);
  return in_world(b.axes, middle);
}

/// The normal, world, between a side along the unit vector u and the first edge that it can cross,
/// from number `which` on: one of whose outward normals is across u.
Vec3 normal_between_side_and_edge(Draw& draw, const PlacedHull& b, const Vec3& u, int which) {
  constexpr double parallel = 1e-8;  // sine
  const auto& edges = b.hull.edges();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const std::size_t i = (static_cast<std::size_t>(which) + k) % edges.size();
    const EdgeOfHull edge = normal_of_edge(draw, b.hull, static_cast<int>(i));
    const Vec3 across = cross(u, in_world(b.axes, edge.along));
    if (dot(across, across) < parallel * parallel) return in_world(b.axes, edge.normal);
    const Vec3 n = normalized(across);
    for (const double sign : {1.0, -1.0}) {
      if (b.is_supported_by(b.vertices_of(Feature::edge, edge.number), b.local(sign * n))) {
        return sign * n;
      }
    }
  }
  return draw.direction_across(u);
}

/// The common normal, towards A, where it meets a hull: as for a box A's cap has priority, then B's
/// face.
Vec3 normal_at_hull(Draw& draw, const Vec3& u, Feature on_a, const PlacedHull& b, Feature on_b,
                    int which) {
  if (on_a == Feature::cap) {
    const std::vector<int> vertices = b.vertices_of(on_b, which);
    const Vec3 n = draw.sign() * u;
    const auto meets = [&](const Vec3& way) {
      return !vertices.empty() && b.is_supported_by(vertices, b.local(way));
    };
    return meets(-n) && !meets(n) ? Vec3(-n) : n;
  }
  if (on_b == Feature::cap) {
    return in_world(b.axes, outward_normal(b.hull, which));
  }
  if (on_b == Feature::edge) {
    if (on_a == Feature::side) return normal_between_side_and_edge(draw, b, u, which);
    return in_world(b.axes, normal_of_edge(draw, b.hull, which).normal);
  }
  return on_a == Feature::side ? draw.direction_across(u) : draw.direction();
}

struct PointOnB {
  Draw& draw;
  Feature feature;
  const Axes& axes;
  const Vec3& n;  // world, towards A
  int which;

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
    return in_world(axes, point_on_box(draw, s.half_extents(), feature, in_body(axes, n), which));
  }
  Vec3 operator()(const Convex& s) const {
    return point_on_hull(draw, {s, axes}, feature, n, which);
  }
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
Vec3 common_normal(Draw& draw, const Bodies& bodies, const Axes& axes_a, Feature on_a,
                   const Axes& axes_b, Feature on_b, int edge) {
  const Directions a = directions_of_a(draw, axes_a, on_a);
  const Directions b = directions_of_b(draw, bodies, axes_b, on_b, edge);
  if (std::holds_alternative<Plane>(bodies.b)) return b.axis;
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

EdgeOfHull draw_edge(Draw& draw, const Convex& hull) {
  const auto number = static_cast<int>(draw.integer(0, std::ssize(hull.edges()) - 1));
  return normal_of_edge(draw, hull, number);
}

Cylinder draw_cylinder(Draw& draw) {
  const double radius = draw.log_uniform(0.2, 1);
  return Cylinder(radius, draw.log_uniform(0.2, 1));
}

namespace {

Shape draw_other(Draw& draw, Pair pair, const Modifiers& modifiers) {
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
    case Pair::convex:
      return oracle::convex_hull(draw_hull_points(draw, modifiers.hull(), modifiers.proportions()));
    case Pair::box:
      break;
  }
  const double x = size(), y = size(), z = size();
  return Box(Vec3(x, y, z));
}

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
  if (proportions == Proportions::plate && std::holds_alternative<Box>(bodies.b)) {
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

Bodies draw_bodies(Draw& draw, Pair pair, const Modifiers& modifiers) {
  const Cylinder a = draw_cylinder(draw);
  const Eigen::Quaterniond orientation_a = draw.orientation();
  const Shape b = draw_other(draw, pair, modifiers);
  Bodies bodies{a, orientation_a, b, draw.orientation()};
  reshape(draw, modifiers.proportions(), bodies);
  return bodies;
}

double smaller_size(const Bodies& bodies) {
  return std::min(smallest_half_extent(bodies.a), smallest_half_extent(bodies.b));
}

namespace {

/// Axes of a box, or faces or edges of a hull, of which one is met.
std::int64_t choices(const Shape& b, Feature feature) {
  constexpr std::int64_t axes_of_a_box = 3;
  const auto* hull = std::get_if<Convex>(&b);
  if (!hull || feature == Feature::vertex) return axes_of_a_box;
  return feature == Feature::edge ? std::ssize(hull->edges()) : std::ssize(hull->faces());
}

}  // namespace

Configuration meet(Draw& draw, const Bodies& bodies, Feature on_a, Feature on_b, double distance) {
  const int which = static_cast<int>(draw.integer(0, choices(bodies.b, on_b) - 1));
  return meet_at(draw, bodies, on_a, on_b, distance, which);
}

Configuration meet_at(Draw& draw, const Bodies& bodies, Feature on_a, Feature on_b, double distance,
                      int which) {
  const Axes axes_a = axes(bodies.orientation_a), axes_b = axes(bodies.orientation_b);
  const auto* hull = std::get_if<Convex>(&bodies.b);
  const Vec3 n = hull ? normal_at_hull(draw, axes_a.z, on_a, {*hull, axes_b}, on_b, which)
                      : common_normal(draw, bodies, axes_a, on_a, axes_b, on_b, which);

  const Vec3 point_a =
      in_world(axes_a, point_on_round(draw, bodies.a.radius(), bodies.a.half_length(), on_a,
                                      in_body(axes_a, Vec3(-n))));
  const Vec3 point_b = std::visit(PointOnB{draw, on_b, axes_b, n, which}, bodies.b);
  const Vec3 centre_b{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
  return {bodies.a, Pose(centre_b + ((point_b - point_a) + distance * n), bodies.orientation_a),
          bodies.b, Pose(centre_b, bodies.orientation_b)};
}

namespace {

/// Radius of the largest ball about its origin that a hull holds.
double held_radius(const Convex& hull) {
  double radius = std::numeric_limits<double>::infinity();
  for (int number = 0; number < std::ssize(hull.faces()); ++number) {
    const Convex::Face& face = hull.faces()[static_cast<std::size_t>(number)];
    const Vec3& on_face = hull.vertices()[static_cast<std::size_t>(face.vertices.front())];
    radius = std::min(radius, std::abs(dot(outward_normal(hull, number), on_face)));
  }
  return radius;
}

}  // namespace

Configuration overlap_deeply(Draw& draw, const Bodies& bodies, Proportions proportions) {
  if (std::holds_alternative<Plane>(bodies.b)) {
    const double distance = -bodies.a.half_length() * draw.uniform(0.1, 2);
    return meet(draw, bodies, Feature::rim, Feature::cap, distance);
  }
  const bool thin_a = proportions == Proportions::needle || proportions == Proportions::coin;
  double max_distance = thin_a ? smallest_half_extent(bodies.b) : smaller_size(bodies);
  if (const auto* hull = std::get_if<Convex>(&bodies.b); hull && !hull->is_flat()) {
    max_distance = held_radius(*hull);
    if (!thin_a) max_distance = std::min(max_distance, smallest_half_extent(bodies.a));
  }
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
  if (pair == Pair::convex) n.vertices = draw_hull_points(draw, HullForm::usual);
  if (pair == Pair::plane) {
    n.normal = Vec3(0, 0, 1);
    n.displacement = draw.uniform(-1, 1);
  }
  n.orientation_a = draw.one_in(4) ? draw.orientation() : draw_clear_tilt(draw);
  n.position_a = draw_offset_within(draw, n.sizes);
  const bool has_sizes = pair != Pair::plane && pair != Pair::convex;
  if (has_sizes && draw.one_in(4)) make_depths_alike(draw, n);
  const bool has_sides = pair == Pair::capsule || pair == Pair::cylinder;
  if (has_sides && draw.one_in(4)) cross_at_an_end(draw, n);
  if (pair == Pair::cylinder && draw.one_in(4)) put_caps_together(draw, n);
  if (draw.one_in(4)) scale_both(n, static_cast<int>(draw.integer(-12, 12)));
  return n;
}

}  // namespace touchstone
