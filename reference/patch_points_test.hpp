#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "reference/curves.hpp"

namespace touchstone {

// What tests of a patch's few points share.

inline Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The points of a patch that leans towards a unit vector, but for those that are one.
template <class Patch>
std::vector<Vec2> distinct_points(const Patch& patch, const Vec2& down, double clearness) {
  std::array<Vec2, Patch::max_points> points;
  const Vec2 deepest = clearness > 0 ? patch.farthest(down) : Vec2(0, 0);
  const int count = patch.spread(down, deepest, clearness, points);
  std::vector<Vec2> distinct;
  for (int i = 0; i < count; ++i) {
    constexpr double same = 4e-6;
    const auto is_same = [&](const Vec2& p) { return (p - points[i]).norm() <= same; };
    if (std::none_of(distinct.begin(), distinct.end(), is_same)) distinct.push_back(points[i]);
  }
  return distinct;
}

/// min over directions of (support of the points)/(support of the patch), about its centroid, of a
/// patch that is level.
template <class Patch>
double coverage(const Patch& patch) {
  constexpr int directions = 720;
  Vec2 centroid(0, 0);
  double area = 0;
  for (int i = 0; i < directions; ++i) {  // of the polygon of support points
    const Vec2 p = patch.farthest(direction(2 * std::numbers::pi * i / directions));
    const Vec2 q = patch.farthest(direction(2 * std::numbers::pi * (i + 1) / directions));
    area += cross2(p, q) / 2;
    centroid += cross2(p, q) / 6 * (p + q);
  }
  centroid /= area;
  const auto points = distinct_points(patch, Vec2(0, 0), 0);
  double least = 1;
  for (int i = 0; i < directions; ++i) {
    const Vec2 n = direction(2 * std::numbers::pi * (i + 0.5) / directions);
    double most = -1;
    for (const Vec2& p : points) most = std::max(most, n.dot(p - centroid));
    least = std::min(least, most / n.dot(patch.farthest(n) - centroid));
  }
  return least;
}

}  // namespace touchstone
