#include "oracle/patch/support_feature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "oracle/ball.hpp"

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

  Vec3 unit_axis(int i) const { return rounded(exact.axes[i]) / exact.norm.get_d(); }
  /// +1 or −1: the end of an axis, not perpendicular to the normal, that is farther out.
  int end(int i) const { return sgn(dot(exact.axes[i], out.direction)) < 0 ? -1 : 1; }
  bool is_certain(int i) const {
    const Vec3 axis = unit_axis(i);
    return out.is_exact || (std::abs(axis.dot(out.unit)) > nearly_aligned &&
                            axis.cross(out.unit).norm() > nearly_aligned);
  }
  SupportFeature centred(Kind kind) const {
    SupportFeature f;
    f.kind = kind;
    f.centre = exact.position;
    f.norm = exact.norm;
    f.u = exact.axes[2];
    return f;
  }
};

SupportFeature feature(const Cylinder& shape, const PosedShape& body) {
  switch (body.alignment[2]) {
    case Alignment::parallel: {
      SupportFeature f = body.centred(Kind::disc);
      f.radius = shape.radius();
      return f;
    }
    case Alignment::perpendicular: {
      SupportFeature f = body.centred(Kind::segment);
      f.half_u = shape.half_length();
      return f;
    }
    case Alignment::oblique:
      break;
  }
  SupportFeature f;
  // The component perpendicular to the axis is exact, so that a small tilt loses no digits.
  const RationalVector &n = body.out.direction, &axis = body.exact.axes[2];
  const mpq_class along = dot(axis, n) / (body.exact.norm * body.exact.norm);
  const Vec3 radial = rounded(n - along * axis);
  f.point = body.pose.position() + body.end(2) * shape.half_length() * body.unit_axis(2);
  if (!radial.isZero(0)) f.point += shape.radius() * radial.normalized();
  f.point_is_certain = body.is_certain(2);
  return f;
}

SupportFeature feature(const Capsule& shape, const PosedShape& body) {
  if (body.alignment[2] == Alignment::perpendicular) {
    SupportFeature f = body.centred(Kind::segment);
    f.half_u = shape.half_length();
    return f;
  }
  SupportFeature f;
  f.point = body.pose.position() + body.end(2) * shape.half_length() * body.unit_axis(2) +
            shape.radius() * body.out.unit;
  f.point_is_certain = body.is_certain(2);
  return f;
}

SupportFeature feature(const Sphere& shape, const PosedShape& body) {
  SupportFeature f;
  f.point = body.pose.position() + shape.radius() * body.out.unit;
  return f;
}

SupportFeature feature(const Box& shape, const PosedShape& body) {
  SupportFeature f = body.centred(Kind::point);
  f.point = body.pose.position();
  std::vector<int> across;
  for (int i = 0; i < 3; ++i) {
    if (body.alignment[i] == Alignment::perpendicular) {
      across.push_back(i);
      continue;
    }
    const double half = body.end(i) * shape.half_extents()[i];
    f.point += half * body.unit_axis(i);
    f.centre = f.centre + mpq_class(half) / f.norm * body.exact.axes[i];
    f.point_is_certain = f.point_is_certain && body.is_certain(i);
  }
  if (across.empty()) return f;
  f.kind = across.size() == 1 ? Kind::segment : Kind::rectangle;
  f.u = body.exact.axes[across[0]];
  f.half_u = shape.half_extents()[across[0]];
  if (across.size() == 1) return f;
  f.v = body.exact.axes[across[1]];
  f.half_v = shape.half_extents()[across[1]];
  return f;
}

SupportFeature feature(const Convex&, const PosedShape&) {
  throw std::logic_error("convex: later stage");
}

SupportFeature feature(const Plane&, const PosedShape& body) { return body.centred(Kind::plane); }

/// The normal as an exact vector of any length if it is parallel to an axis or a plane's normal;
/// otherwise its doubles.
Outward from_b_to_a(const Configuration& c, const OptimalNormal& normal, const ExactPose& a,
                    const ExactPose& b) {
  const auto towards_a = [&](const RationalVector& axis) {
    const bool same_way = rounded(axis).dot(normal.n) > 0;
    return Outward{same_way ? axis : -axis, true, normal.n};
  };
  if (const auto* plane = std::get_if<Plane>(&c.b)) {
    const RationalVector local = exact(plane->normal());
    return towards_a(local.x * b.axes[0] + local.y * b.axes[1] + local.z * b.axes[2]);
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
  const PosedShape body_a{c.pose_a, a, out_of_a, to_a};
  const PosedShape body_b{c.pose_b, b, out_of_b, normal.to_b};
  return {feature(c.a, body_a),
          std::visit([&](const auto& shape) { return feature(shape, body_b); }, c.b)};
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

struct Part {
  Vec3 n;
  double epsilon;
  std::vector<Vec3> points;

  // A point of the cylinder at polar angle φ (zero: highest) and height w along the axis is lower
  // than the highest point by r s (1 − cos φ) + c (h − w), where c and s are the cosine and sine of
  // the angle between the axis and n. For each φ the part is an interval of w up to h. Its hull is
  // that of the upper rim, the cut across the side, and the lower rim if the part reaches it.
  void add(const Cylinder& shape, const Vec3& centre, const Eigen::Matrix3d& axes) {
    const double r = shape.radius(), h = shape.half_length();
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

  // The part of a ball within `left` of its top is a disc, seen along n.
  void add_ball(double r, const Vec3& centre, double left, int count) {
    const double radius = left < r ? std::sqrt(left * (2 * r - left)) : r;
    const Vec3 e1 = n.unitOrthogonal(), e2 = n.cross(e1);
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      points.push_back(centre + radius * (std::cos(angle) * e1 + std::sin(angle) * e2));
    }
  }

  void add(const Sphere& shape, const Vec3& centre, const Eigen::Matrix3d&) {
    add_ball(shape.radius(), centre, epsilon, chords);
  }

  // Balls about points of the segment, from the highest to the lowest that reaches the part. The
  // remaining epsilon decreases as a square, so that the radii decrease evenly.
  void add(const Capsule& shape, const Vec3& centre, const Eigen::Matrix3d& axes) {
    constexpr int balls = 12;
    const double r = shape.radius(), h = shape.half_length();
    const Vec3 up = axes.col(2).dot(n) < 0 ? Vec3(-axes.col(2)) : Vec3(axes.col(2));
    const double c = up.dot(n);
    const double lowest_root = std::sqrt(std::max(0.0, 1 - 2 * h * c / epsilon));
    for (int i = 0; i <= balls; ++i) {
      const double root = 1 - (1 - lowest_root) * i / balls;
      const double left = epsilon * root * root;
      // A segment perpendicular to n lies in the part with both ends.
      const bool at_end = i == balls && lowest_root > 0;
      const double w = i == 0 ? h : at_end || c == 0 ? -h : std::max(-h, h - (epsilon - left) / c);
      add_ball(r, centre + w * up, left, chords / 2);
    }
  }

  void add(const Box& shape, const Vec3& centre, const Eigen::Matrix3d& axes) {
    const Vec3& h = shape.half_extents();
    const Vec3 along = axes.transpose() * n;
    const auto corner = [&](int bits) {
      return Vec3(bits & 1 ? h.x() : -h.x(), bits & 2 ? h.y() : -h.y(), bits & 4 ? h.z() : -h.z());
    };
    // A corner is lower than the highest one by the sum of 2 h |axis·n| over the axes at whose
    // lower end it lies: a sum without cancellation.
    const auto below = [&](int bits) {
      double sum = 0;
      for (int i = 0; i < 3; ++i) {
        const bool lower_end = ((bits >> i & 1) != 0) != (along[i] > 0);
        if (lower_end) sum += 2 * h[i] * std::abs(along[i]);
      }
      return sum;
    };
    for (int bits = 0; bits < 8; ++bits) {
      const double depth = below(bits);
      if (depth <= epsilon) points.push_back(centre + axes * corner(bits));
      for (int i = 0; i < 3; ++i) {
        const double other = below(bits ^ 1 << i);
        if (!(depth <= epsilon && other > epsilon)) continue;
        const double t = (epsilon - depth) / (other - depth);
        points.push_back(centre + axes * ((1 - t) * corner(bits) + t * corner(bits ^ 1 << i)));
      }
    }
  }

  void add(const Convex&, const Vec3&, const Eigen::Matrix3d&) {
    throw std::logic_error("convex: later stage");
  }

  void add(const Plane&, const Vec3&, const Eigen::Matrix3d&) {}
};

/// Width of the part along an axis of half length h with the cosine c to n, seen along n; zero if
/// the whole axis lies in the part.
double width_along(double h, double c, double epsilon) {
  return 2 * h * c > epsilon ? epsilon / c * std::sqrt(std::max(0.0, 1 - c * c)) : 0;
}

double ball_width(double r, double epsilon) {
  return epsilon < r ? 2 * std::sqrt(epsilon * (2 * r - epsilon)) : 2 * r;
}

WidthFromEpsilon width(const Cylinder& shape, const Vec3& n, double epsilon) {
  const double r = shape.radius(), h = shape.half_length();
  const double s = std::hypot(n.x(), n.y()), c = std::abs(n.z());
  const double along = width_along(h, c, epsilon);
  if (2 * r * s <= epsilon) return {along, false};
  const double round = 2 * r * std::sin(std::min(reach(r * s, epsilon), std::numbers::pi / 2));
  return {std::max(along, round), 2 * h * c > epsilon};
}
WidthFromEpsilon width(const Sphere& shape, const Vec3&, double epsilon) {
  return {ball_width(shape.radius(), epsilon), true};
}
WidthFromEpsilon width(const Capsule& shape, const Vec3& n, double epsilon) {
  const double h = shape.half_length(), c = std::abs(n.z());
  return {ball_width(shape.radius(), epsilon) + width_along(h, c, epsilon), 2 * h * c > epsilon};
}
WidthFromEpsilon width(const Box& shape, const Vec3& n, double epsilon) {
  WidthFromEpsilon result{0, true};
  for (int i = 0; i < 3; ++i) {
    const double h = shape.half_extents()[i], c = std::abs(n[i]);
    result.largest = std::max(result.largest, width_along(h, c, epsilon));
    result.is_a_corner = result.is_a_corner && 2 * h * c > epsilon;
  }
  return result;
}
WidthFromEpsilon width(const Convex&, const Vec3&, double) {
  throw std::logic_error("convex: later stage");
}
WidthFromEpsilon width(const Plane&, const Vec3&, double) { return {0, false}; }

}  // namespace

WidthFromEpsilon width_from_epsilon(const Shape& shape, const Pose& pose, const Vec3& n,
                                    double epsilon) {
  const Vec3 local = pose.rotation().transpose() * n;
  return std::visit([&](const auto& s) { return width(s, local, epsilon); }, shape);
}

std::vector<Vec3> support_part(const Shape& shape, const Pose& pose, const Vec3& n, double epsilon,
                               const Vec3& origin) {
  Part part{n, epsilon, {}};
  std::visit([&](const auto& s) { part.add(s, Vec3(pose.position() - origin), pose.rotation()); },
             shape);
  return part.points;
}

}  // namespace touchstone::oracle
