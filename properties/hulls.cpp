// Hulls as people have them, and as rounding leaves them. Where faces are meant to be plane their
// vertices are so to the last bit: they share coordinates, or are whole numbers of one length.
#include "properties/hulls.hpp"

#include <array>
#include <cmath>

#include "oracle/hull.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

double draw_length(Draw& draw) { return draw.log_uniform(0.2, 1); }

/// Of a box about the origin.
std::vector<Vec3> box_corners(const Vec3& half) {
  std::vector<Vec3> corners;
  for (const double x : {half.x(), -half.x()}) {
    for (const double y : {half.y(), -half.y()}) {
      for (const double z : {half.z(), -half.z()}) corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

/// Moves the mean to the origin. Axes along which all points are at zero stay so.
void move_mean_to_origin(std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  const Vec3 mean = sum / static_cast<double>(points.size());
  for (Vec3& p : points) p -= mean;
}

/// 4 to 32 points in a ball.
std::vector<Vec3> draw_cloud(Draw& draw) {
  constexpr double fewest = 4, most = 32;
  const double size = draw_length(draw);
  const int count = static_cast<int>(draw.log_uniform(fewest, most + 0.5));
  std::vector<Vec3> points;
  while (static_cast<int>(points.size()) < count) {
    const double x = draw.uniform(-1, 1), y = draw.uniform(-1, 1), z = draw.uniform(-1, 1);
    if (x * x + y * y + z * z <= 1) points.push_back(size * Vec3(x, y, z));
  }
  move_mean_to_origin(points);
  return points;
}

/// The three points at (0, x, y) and the coordinates in turn.
void add_turned(std::vector<Vec3>& points, double x, double y) {
  points.emplace_back(0, x, y);
  points.emplace_back(y, 0, x);
  points.emplace_back(x, y, 0);
}

/// One of the five regular solids. Its size has few bits, so that products with it are exact. The
/// faces of a dodecahedron of doubles are not plane; here 5/8 stands for the ratio 0.618 of a
/// regular one, with which they are.
std::vector<Vec3> draw_regular(Draw& draw) {
  constexpr double unit = 0x1p-10, golden = 0x1.9e3779b97f4a8p+0, ratio = 0.625;
  const double size = unit * static_cast<double>(draw.integer(205, 1023));
  std::vector<Vec3> points;
  switch (draw.integer(0, 4)) {
    case 0:
      points = {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
      break;
    case 1:
      points = box_corners(Vec3(1, 1, 1));
      break;
    case 2:
      for (const double sign : {1.0, -1.0}) add_turned(points, 0, sign);
      break;
    case 3:
      points = box_corners(Vec3(1, 1, 1));
      for (const double x : {1 + ratio, -1 - ratio}) {
        for (const double y : {1 - ratio * ratio, ratio * ratio - 1}) add_turned(points, x, y);
      }
      break;
    default:
      for (const double x : {1.0, -1.0}) {
        for (const double y : {golden, -golden}) add_turned(points, x, y);
      }
  }
  for (Vec3& p : points) p *= size;
  return points;
}

/// Both caps of a prism with so many sides, regular but for rounding: by square roots alone.
std::vector<Vec3> draw_prism(Draw& draw) {
  // Halve the angle of a triangle or square.
  const bool is_of_three = draw.coin();
  double cosine = is_of_three ? -0.5 : 0, sine = is_of_three ? std::sqrt(0.75) : 1;
  int sides = is_of_three ? 3 : 4;
  for (std::int64_t halvings = draw.integer(0, 2); halvings > 0; --halvings) {
    sine = std::sqrt((1 - cosine) / 2);
    cosine = std::sqrt((1 + cosine) / 2);
    sides *= 2;
  }
  const double radius = draw_length(draw), half_length = draw_length(draw);
  std::vector<Vec3> points;
  double x = 1, y = 0;
  for (int i = 0; i < sides; ++i) {
    for (const double z : {half_length, -half_length}) {
      points.emplace_back(radius * x, radius * y, z);
    }
    const double next = cosine * x - sine * y;
    y = sine * x + cosine * y;
    x = next;
  }
  return points;
}

/// In the plane z = 0, with an area of at least a tenth of its size squared.
std::vector<Vec3> draw_triangle(Draw& draw) {
  const double size = draw_length(draw);
  for (;;) {
    std::vector<Vec3> points;
    for (int i = 0; i < 3; ++i) {
      const double x = draw.uniform(-1, 1), y = draw.uniform(-1, 1);
      points.emplace_back(x, y, 0);
    }
    if (std::abs(cross(points[1] - points[0], points[2] - points[0]).z()) < 0.2) continue;
    for (Vec3& p : points) p *= size;
    move_mean_to_origin(points);
    return points;
  }
}

/// Two large faces that meet along y at a small angle.
std::vector<Vec3> draw_wedge(Draw& draw) {
  const double length = draw_length(draw), breadth = draw_length(draw);
  const double thick = length * draw.log_uniform(1e-6, 1e-1);
  std::vector<Vec3> points;
  for (const double y : {breadth, -breadth}) {
    points.emplace_back(length, y, 0);
    for (const double z : {thick, -thick}) points.emplace_back(-length / 2, y, z);
  }
  return points;
}

/// A box's corners, more points of its faces, and two of its corners again: each off by so much.
std::vector<Vec3> draw_nearly_coplanar(Draw& draw) {
  const double x = draw_length(draw), y = draw_length(draw), z = draw_length(draw);
  std::vector<Vec3> points = box_corners(Vec3(x, y, z));
  for (const int corner : {0, 7}) points.push_back(points[static_cast<std::size_t>(corner)]);
  for (int i = 0; i < 6; ++i) {
    const Vec3 half(x, y, z);
    Vec3 p{x * draw.uniform(-1, 1), y * draw.uniform(-1, 1), z * draw.uniform(-1, 1)};
    p[i / 2] = (i % 2 == 0 ? 1 : -1) * half[i / 2];
    points.push_back(p);
  }
  const double off = draw.log_uniform(1e-15, 1e-3);
  for (Vec3& p : points) p += off * draw.direction();
  return points;
}

std::vector<Vec3> draw_points(Draw& draw, HullForm kind) {
  switch (kind) {
    case HullForm::regular:
      return draw_regular(draw);
    case HullForm::of_box: {
      const double x = draw_length(draw), y = draw_length(draw);
      return box_corners(Vec3(x, y, draw_length(draw)));
    }
    case HullForm::of_prism:
      return draw_prism(draw);
    case HullForm::triangle:
      return draw_triangle(draw);
    case HullForm::wedge:
      return draw_wedge(draw);
    case HullForm::nearly_coplanar:
      return draw_nearly_coplanar(draw);
    case HullForm::usual:
      break;
  }
  return draw_cloud(draw);
}

}  // namespace

std::vector<Vec3> draw_hull_points(Draw& draw, HullForm kind, Proportions proportions) {
  std::vector<Vec3> points = draw_points(draw, kind);
  if (proportions != Proportions::plate) return points;
  const std::array<bool, 3> is_thin = draw_thin_extents(draw);
  for (Vec3& p : points) {
    for (int i = 0; i < 3; ++i) {
      if (is_thin[static_cast<std::size_t>(i)]) p[i] /= static_cast<double>(extreme_ratio);
    }
  }
  return points;
}

bool has_hull(const std::vector<Vec3>& points) {
  try {
    oracle::convex_hull(points);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace touchstone
