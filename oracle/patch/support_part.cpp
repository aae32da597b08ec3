#include <algorithm>
#include <cmath>
#include <numbers>

#include "oracle/patch/support_feature.hpp"

namespace touchstone::oracle {
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
