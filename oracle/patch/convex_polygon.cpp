#include "oracle/patch/convex_polygon.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <algorithm>
#include <iterator>
#include <limits>

namespace touchstone::oracle {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The part of a polygon left of the line from `a` to `b` (Sutherland and Hodgman 1974).
std::vector<Vec2> left_of(const std::vector<Vec2>& polygon, const Vec2& a, const Vec2& b) {
  std::vector<Vec2> kept;
  kept.reserve(polygon.size() + 1);
  const Vec2 along = b - a;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double side_p = cross(along, p - a), side_q = cross(along, q - a);
    if (side_p >= 0) kept.push_back(p);
    if ((side_p >= 0) != (side_q >= 0)) kept.push_back(p + side_p / (side_p - side_q) * (q - p));
  }
  return kept;
}

Vec2 nearest_on_boundary(const std::vector<Vec2>& polygon, const Vec2& p) {
  Vec2 nearest = polygon[0];
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2 along = polygon[(i + 1) % polygon.size()] - a;
    const double length2 = along.squaredNorm();
    if (!(length2 > 0)) continue;
    const Vec2 q = a + std::clamp((p - a).dot(along) / length2, 0.0, 1.0) * along;
    if ((p - q).squaredNorm() < (p - nearest).squaredNorm()) nearest = q;
  }
  return nearest;
}

}  // namespace

std::vector<Vec2> convex_hull(const std::vector<Vec2>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> all, extreme;
  all.reserve(points.size());
  for (const Vec2& p : points) all.emplace_back(p.x(), p.y());
  CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(extreme));
  std::vector<Vec2> hull;
  hull.reserve(extreme.size());
  for (const auto& p : extreme) hull.emplace_back(p.x(), p.y());
  return hull;
}

std::vector<Vec2> intersection(const std::vector<Vec2>& p, const std::vector<Vec2>& q) {
  if (q.size() < 3 && p.size() >= 3) return intersection(q, p);
  if (q.size() < 3) return {};
  std::vector<Vec2> common = p;
  for (std::size_t i = 0; i < q.size() && !common.empty(); ++i) {
    common = left_of(common, q[i], q[(i + 1) % q.size()]);
  }
  return common.empty() ? common : convex_hull(common);
}

Vec2 halfway(const std::vector<Vec2>& p, const std::vector<Vec2>& q) {
  double least = std::numeric_limits<double>::infinity();
  Vec2 middle = p[0];
  const auto meet = [&](const std::vector<Vec2>& vertices, const std::vector<Vec2>& other) {
    for (const Vec2& v : vertices) {
      const Vec2 w = nearest_on_boundary(other, v);
      if ((v - w).norm() < least) {
        least = (v - w).norm();
        middle = (v + w) / 2;
      }
    }
  };
  meet(p, q);
  meet(q, p);
  return middle;
}

}  // namespace touchstone::oracle
