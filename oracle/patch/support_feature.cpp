#include "oracle/patch/support_feature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "oracle/ball.hpp"
#include "oracle/body.hpp"

namespace touchstone::oracle {

RationalVector exact(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 rounded(const RationalVector& v) { return {v.x.get_d(), v.y.get_d(), v.z.get_d()}; }

ExactPose::ExactPose(const Pose& pose) : position(exact(pose.position())) {
  const Eigen::Quaterniond& q = pose.orientation();
  const ExactRotation<mpq_class> rotation(q.w(), q.x(), q.y(), q.z());
  axes = rotation.columns;
  norm = rotation.norm;
}

namespace {

using Kind = SupportFeature::Kind;

/// Below this sine or cosine between axis and normal, the normal's rounding of 1e-16 moves a rim
/// point by more than 1e-4 of its radius.
constexpr double nearly_aligned = 1e-12;

/// The direction out of a body, towards the other one.
struct Outward {
  RationalVector direction;  ///< its length has no meaning
  bool is_exact;
  Vec3 unit;
};

struct PosedShape {
  const Pose& pose;
  const ExactPose exact;
  const Outward& out;
  const std::array<Alignment, 3>& alignment;  ///< to the body's axes
  std::vector<int> support;                   ///< OptimalNormal::support_b of body B

  Vec3 unit_axis(int i) const { return rounded(exact.axes[i]) / exact.norm.get_d(); }
  /// +1 or −1: the end of an axis, not perpendicular to the normal, that is farther out.
  int end(int i) const { return sgn(dot(exact.axes[i], out.direction)) < 0 ? -1 : 1; }
  /// Does the normal tell which end of an axis is farther out, and to which side it leans?
  bool is_certain(int i) const {
    return out.is_exact || std::abs(unit_axis(i).dot(out.unit)) > nearly_aligned;
  }
  bool leans_certainly() const {
    return out.is_exact || unit_axis(2).cross(out.unit).norm() > nearly_aligned;
  }
  SupportFeature centred(Kind kind) const {
    SupportFeature f;
    f.kind = kind;
    f.centre = exact.position;
    f.u = exact.axes[2];
    return f;
  }
  /// Of corners in order, either way round.
  SupportFeature polygon(std::vector<RationalVector> corners) const {
    const RationalVector area = cross(corners[1] - corners[0], corners[2] - corners[1]);
    if (dot(area, out.direction) < 0) std::reverse(corners.begin(), corners.end());
    SupportFeature f;
    f.kind = Kind::polygon;
    f.corners = std::move(corners);
    return f;
  }
};

// Of a rounded body the feature is that of its core, which may be a disc, a segment or a point; a
// point is moved out by the rounding, while what others have along the normal has no meaning.

/// Of a box and a disc.
SupportFeature feature(const Body& shape, const PosedShape& body) {
  const auto radius = shape.of_core<mpq_class>(shape.disc_radius);
  SupportFeature f = body.centred(Kind::disc);
  f.radius = radius;
  if (body.alignment[2] == Alignment::parallel && radius > 0) return f;
  f.kind = Kind::point;
  f.point = body.pose.position();
  std::vector<RationalVector> across;  // halves of the box
  for (int i = 0; i < 3; ++i) {
    const auto half = shape.of_core<mpq_class>(shape.half_extents[i]);
    if (half == 0) continue;
    const RationalVector along = half / body.exact.norm * body.exact.axes[i];
    if (body.alignment[i] == Alignment::perpendicular) {
      across.push_back(along);
      continue;
    }
    f.point += body.end(i) * shape.of_core(shape.half_extents[i]) * body.unit_axis(i);
    f.centre = f.centre + body.end(i) * along;
    f.point_is_certain = f.point_is_certain && body.is_certain(i);
  }
  if (across.size() > 1) {
    const RationalVector sum = across[0] + across[1], difference = across[0] - across[1];
    return body.polygon(
        {f.centre - sum, f.centre + difference, f.centre + sum, f.centre - difference});
  }
  if (across.size() == 1) {
    f.kind = Kind::segment;
    f.u = across[0];
    return f;
  }
  f.point += shape.ball_radius * body.out.unit;
  if (radius == 0) return f;
  // The component perpendicular to the axis is exact, so that a small tilt loses no digits.
  const RationalVector &n = body.out.direction, &axis = body.exact.axes[2];
  const mpq_class along = dot(axis, n) / (body.exact.norm * body.exact.norm);
  const Vec3 radial = rounded(n - along * axis);
  if (!radial.isZero(0)) f.point += shape.core_radius() * radial.normalized();
  f.point_is_certain = f.point_is_certain && body.leans_certainly();
  return f;
}

/// The vertices that lie in the support plane, as far as the direction tells.
std::vector<int> highest_vertices(const Convex& shape, const PosedShape& body) {
  const auto& axes = body.exact.axes;
  const RationalVector& n = body.out.direction;
  const RationalVector local{dot(axes[0], n), dot(axes[1], n), dot(axes[2], n)};
  std::vector<int> highest;
  mpq_class most;
  for (std::size_t i = 0; i < shape.vertices().size(); ++i) {
    const mpq_class height = dot(local, exact(shape.vertices()[i]));
    if (highest.empty() || height > most) most = height, highest.clear();
    if (height == most) highest.push_back(static_cast<int>(i));
  }
  return highest;
}

SupportFeature feature(const Convex& shape, const PosedShape& body) {
  const auto corner = [&](int i) {
    return body.exact.position +
           1 / body.exact.norm * body.exact.turned(exact(shape.vertices()[i]));
  };
  const bool is_known = !body.support.empty();
  const std::vector<int> support = is_known ? body.support : highest_vertices(shape, body);
  if (support.size() == 2) {
    const RationalVector p = corner(support[0]), q = corner(support[1]);
    SupportFeature f;
    f.kind = Kind::segment;
    f.centre = mpq_class(1, 2) * (p + q);
    f.u = mpq_class(1, 2) * (q - p);
    return f;
  }
  for (const Convex::Face& face : shape.faces()) {
    const auto is_of_face = [&](int i) {
      return std::find(face.vertices.begin(), face.vertices.end(), i) != face.vertices.end();
    };
    if (support.size() != face.vertices.size()) continue;
    if (!std::all_of(support.begin(), support.end(), is_of_face)) continue;
    std::vector<RationalVector> corners;
    for (const int i : face.vertices) corners.push_back(corner(i));
    return body.polygon(std::move(corners));
  }
  SupportFeature f;
  f.point = rounded(corner(support[0])) + shape.rounding() * body.out.unit;
  f.point_is_certain = support.size() == 1 && (is_known || body.out.is_exact);
  return f;
}

SupportFeature feature(const Shape& shape, const PosedShape& body) {
  if (std::holds_alternative<Plane>(shape)) return body.centred(Kind::plane);
  const auto* const hull = std::get_if<Convex>(&shape);
  return hull ? feature(*hull, body) : feature(Body(shape), body);
}

/// The normal as an exact vector of any length if it is parallel to an axis or a plane's normal;
/// otherwise its doubles.
Outward from_b_to_a(const Configuration& c, const OptimalNormal& normal, const ExactPose& a,
                    const ExactPose& b) {
  const auto towards_a = [&](const RationalVector& axis) {
    return Outward{dot(axis, exact(normal.n)) > 0 ? axis : -axis, true, normal.n};
  };
  if (const auto* plane = std::get_if<Plane>(&c.b))
    return towards_a(b.turned(exact(plane->normal())));
  if (normal.support_b.size() > 2) {  // any three corners of a face span it
    const auto corner = [&](int k) {
      return exact(std::get<Convex>(c.b).vertices()[normal.support_b[k]]);
    };
    return towards_a(b.turned(cross(corner(1) - corner(0), corner(2) - corner(0))));
  }
  if (normal.to_a == Alignment::parallel) return towards_a(a.axes[2]);
  for (int i = 0; i < 3; ++i) {
    if (normal.to_b[i] == Alignment::parallel) return towards_a(b.axes[i]);
  }
  return {exact(normal.n), false, normal.n};
}

}  // namespace

SupportFeatures support_features(const Configuration& c, const OptimalNormal& normal) {
  const ExactPose a(c.pose_a), b(c.pose_b);
  const Outward out_of_b = from_b_to_a(c, normal, a, b);
  const Outward out_of_a{-out_of_b.direction, out_of_b.is_exact, -out_of_b.unit};
  const std::array<Alignment, 3> to_a{Alignment::oblique, Alignment::oblique, normal.to_a};
  const PosedShape body_a{c.pose_a, a, out_of_a, to_a, {}};
  const PosedShape body_b{c.pose_b, b, out_of_b, normal.to_b, normal.support_b};
  return {feature(Body(c.a), body_a), feature(c.b, body_b)};
}

namespace {

/// Chords per arc, whatever its length: a full circle loses 1 − cos(π/96) = 5e-4 of its radius.
constexpr int chords = 96;

/// Half the angle of the arc about the highest point of a circle of radius r > 0 that is at most
/// `lower` below that point; at most π.
double reach(double r, double lower) {
  if (lower <= 0) return 0;
  return lower < 2 * r ? 2 * std::asin(std::sqrt(lower / (2 * r))) : std::numbers::pi;
}

std::size_t highest_of(const std::vector<Vec3>& vertices, const Vec3& n) {
  std::size_t highest = 0;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    if ((vertices[i] - vertices[highest]).dot(n) > 0) highest = i;
  }
  return highest;
}

/// How much lower each vertex is than the highest one along n: differences of vertices come first,
/// so that nothing cancels.
std::vector<double> below_the_highest(const std::vector<Vec3>& vertices, const Vec3& n) {
  const Vec3& top = vertices[highest_of(vertices, n)];
  std::vector<double> below;
  below.reserve(vertices.size());
  for (const Vec3& v : vertices) below.push_back(std::max(0.0, (top - v).dot(n)));
  return below;
}

/// Seen along n, the part of a ball within `left` of its top is a disc of this radius.
double radius_of_ball_part(double r, double left) {
  return left < r ? std::sqrt(left * (2 * r - left)) : r;
}

/// Of a body's core.
struct Part {
  Vec3 n;
  double epsilon;
  std::vector<Vec3> points;

  // A point of the cylinder at polar angle φ (zero: highest) and height w along the axis is lower
  // than the highest point by r s (1 − cos φ) + c (h − w), where c and s are the cosine and sine of
  // the angle between the axis and n. For each φ the part is an interval of w up to h. Its hull is
  // that of the upper rim, the cut across the side, and the lower rim if the part reaches it.
  void add_cylinder(double r, double h, const Vec3& centre, const Eigen::Matrix3d& axes) {
    const Vec3 up = axes.col(2).dot(n) < 0 ? Vec3(-axes.col(2)) : Vec3(axes.col(2));
    const double c = up.dot(n);
    const Vec3 lateral(axes.col(0).dot(n), axes.col(1).dot(n), 0);
    const double s = lateral.norm();
    const Vec3 outward = s > 0 ? Vec3(axes * lateral / s) : Vec3(axes.col(0));
    const Vec3 sideways = up.cross(outward);

    const double upper = reach(r * s, epsilon), lower = reach(r * s, epsilon - 2 * h * c);
    const auto add_arc = [&](double from, double to, int count, const auto& height) {
      for (int i = 0; i <= count; ++i) {
        const double angle = from + (to - from) * i / count;
        points.push_back(centre + r * std::cos(angle) * outward + r * std::sin(angle) * sideways +
                         height(angle) * up);
      }
    };
    const auto cut = [&](double angle) {
      const double sine = std::sin(angle / 2);
      const double left = std::max(0.0, epsilon - 2 * r * s * sine * sine);
      return left < 2 * h * c ? h - left / c : -h;
    };
    add_arc(-upper, upper, chords, [h](double) { return h; });
    if (epsilon > 2 * h * c) add_arc(-lower, lower, chords, [h](double) { return -h; });
    if (lower < upper) {
      add_arc(lower, upper, chords / 2, cut);
      add_arc(-upper, -lower, chords / 2, cut);
    }
  }

  void add_box(const Vec3& half_extents, const Vec3& centre, const Eigen::Matrix3d& axes) {
    std::vector<Vec3> corners;
    std::vector<Convex::Edge> edges;
    for (int bits = 0; bits < 8; ++bits) {
      const Vec3 signs(bits & 1 ? 1 : -1, bits & 2 ? 1 : -1, bits & 4 ? 1 : -1);
      corners.emplace_back(signs.cwiseProduct(half_extents));
      for (int i = 0; i < 3; ++i) {
        if (!(bits >> i & 1)) edges.push_back({{bits, bits | 1 << i}, {}});
      }
    }
    add_polytope(corners, edges, centre, axes);
  }

  // The vertices in the part, and where edges leave it.
  void add_polytope(const std::vector<Vec3>& vertices, const std::vector<Convex::Edge>& edges,
                    const Vec3& centre, const Eigen::Matrix3d& axes) {
    const std::vector<double> below = below_the_highest(vertices, axes.transpose() * n);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (below[i] <= epsilon) points.push_back(centre + axes * vertices[i]);
    }
    for (const auto& [ends, faces] : edges) {
      const auto [high, low] =
          std::minmax(ends[0], ends[1], [&](int i, int j) { return below[i] < below[j]; });
      if (!(below[high] <= epsilon && below[low] > epsilon)) continue;
      const double t = (epsilon - below[high]) / (below[low] - below[high]);
      points.push_back(centre + axes * ((1 - t) * vertices[high] + t * vertices[low]));
    }
  }

  void add_core(const Body& shape, const Vec3& centre, const Eigen::Matrix3d& axes) {
    const Vec3 half = shape.core_half_extents();
    if (shape.hull) {
      add_polytope(shape.hull->vertices(), shape.hull->edges(), centre, axes);
    } else if (shape.core_radius() > 0) {
      add_cylinder(shape.core_radius(), half.z(), centre, axes);
    } else {
      add_box(half, centre, axes);
    }
  }
};

/// Width of the part along an axis of half length h with the cosine c to n, seen along n; zero if
/// the whole axis lies in the part.
double width_along(double h, double c, double epsilon) {
  return 2 * h * c > epsilon ? epsilon / c * std::sqrt(std::max(0.0, 1 - c * c)) : 0;
}

double ball_width(double r, double epsilon) {
  return epsilon < r ? 2 * std::sqrt(epsilon * (2 * r - epsilon)) : 2 * r;
}

/// Of a core of box and disc.
WidthFromEpsilon width(const Body& shape, const Vec3& n, double epsilon) {
  WidthFromEpsilon result{0, true};
  for (int i = 0; i < 3; ++i) {
    const double h = shape.core_half_extents()[i], c = std::abs(n[i]);
    result.largest = std::max(result.largest, width_along(h, c, epsilon));
    result.is_a_corner = result.is_a_corner && (h == 0 || 2 * h * c > epsilon);
  }
  const double r = shape.core_radius(), s = std::hypot(n.x(), n.y());
  if (r == 0) return result;
  if (2 * r * s <= epsilon) return {result.largest, false};
  const double round = 2 * r * std::sin(std::min(reach(r * s, epsilon), std::numbers::pi / 2));
  return {std::max(result.largest, round), result.is_a_corner};
}
/// By the edges of the highest vertex, as of a box.
WidthFromEpsilon width(const Convex& shape, const Vec3& n, double epsilon) {
  const std::vector<Vec3>& vertices = shape.vertices();
  const int top = static_cast<int>(highest_of(vertices, n));
  WidthFromEpsilon result{0, true};
  std::vector<int> beside;  // the faces along edges that lie in the part
  for (const auto& [ends, faces] : shape.edges()) {
    if (ends[0] != top && ends[1] != top) continue;
    const Vec3 down = vertices[top] - vertices[ends[0] + ends[1] - top];
    const double depth = down.dot(n);
    if (depth > epsilon) {
      result.largest = std::max(result.largest, epsilon / depth * down.cross(n).norm());
      continue;
    }
    result.is_a_corner = false;
    for (const int face : faces) {
      if (std::find(beside.begin(), beside.end(), face) != beside.end()) return {0, false};
      beside.push_back(face);
    }
  }
  return result;
}

/// A point of the core that is lower than its highest one by less than epsilon carries a ball, of
/// which the part within the rest of epsilon counts: the points that are farthest in all directions
/// about n, of balls on the parts of the core within several depths, and on the corners of that
/// within epsilon.
std::vector<Vec3> rounded_part(const Body& shape, const Vec3& centre, const Eigen::Matrix3d& axes,
                               const Vec3& n, double epsilon) {
  constexpr int rests = 16;
  constexpr double nothing = 1e-12;  // of epsilon: the core's highest points
  struct Carried {
    Vec3 centre;
    double radius;
  };
  std::vector<std::vector<Carried>> of_depths;
  const auto core_within = [&](double depth) {
    Part core{n, depth, {}};
    core.add_core(shape, centre, axes);
    return core.points;
  };
  std::vector<Vec3> higher;
  for (int i = 0; i <= rests; ++i) {
    // They decrease as a square, so that the radii of the balls' parts decrease evenly.
    const double root = 1 - static_cast<double>(i) / rests, rest = epsilon * root * root;
    std::vector<Vec3> points = core_within(std::max(epsilon - rest, nothing * epsilon));
    if (points == higher) continue;  // with smaller balls
    higher = std::move(points);
    auto& balls = of_depths.emplace_back();
    for (const Vec3& p : higher) {
      balls.push_back({p, radius_of_ball_part(shape.ball_radius, rest)});
    }
  }
  const std::vector<Vec3> within = core_within(epsilon);
  const auto height = [&](const Vec3& p) { return p.dot(n); };
  const double top = height(*std::ranges::max_element(within, {}, height));
  auto& corners = of_depths.emplace_back();
  for (const Vec3& p : within) {
    const double rest = std::clamp(epsilon - (top - height(p)), 0.0, epsilon);
    corners.push_back({p, radius_of_ball_part(shape.ball_radius, rest)});
  }

  const Vec3 e1 = n.unitOrthogonal(), e2 = n.cross(e1);
  std::vector<Vec3> points;
  for (int k = 0; k < chords; ++k) {
    const double angle = 2 * std::numbers::pi * k / chords;
    const Vec3 direction = std::cos(angle) * e1 + std::sin(angle) * e2;
    const auto reach_of = [&](const Carried& b) { return b.centre.dot(direction) + b.radius; };
    for (const auto& balls : of_depths) {
      const Carried& farthest = *std::ranges::max_element(balls, {}, reach_of);
      points.push_back(farthest.centre + farthest.radius * direction);
    }
  }
  return points;
}

}  // namespace

WidthFromEpsilon width_from_epsilon(const Shape& shape, const Pose& pose, const Vec3& n,
                                    double epsilon) {
  if (std::holds_alternative<Plane>(shape)) return {0, false};
  const Vec3 local = pose.rotation().transpose() * n;
  const Body body(shape);
  WidthFromEpsilon result =
      body.hull ? width(*body.hull, local, epsilon) : width(body, local, epsilon);
  if (body.ball_radius > 0) result.largest += ball_width(body.ball_radius, epsilon);
  return result;
}

std::vector<Vec3> support_part(const Shape& shape, const Pose& pose, const Vec3& n, double epsilon,
                               const Vec3& origin) {
  const Vec3 centre = pose.position() - origin;
  const Body body(shape);
  if (body.ball_radius > 0) return rounded_part(body, centre, pose.rotation(), n, epsilon);
  Part part{n, epsilon, {}};
  part.add_core(body, centre, pose.rotation());
  return part.points;
}

}  // namespace touchstone::oracle
