#include "oracle/hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

int side(const Point& p, const Point& q, const Point& r, const Point& x) {
  return CGAL::orientation(p, q, r, x);
}

/// The corners of points in one plane, counterclockwise in a projection that keeps the plane whole.
std::vector<int> polygon(const std::vector<Point>& points, std::vector<int> on, bool& reversed,
                         const std::array<int, 3>& triple) {
  const auto turn = [&](int drop, int i, int j, int k) {
    const auto flat = [&](int v) {
      const Point& p = points[static_cast<std::size_t>(v)];
      return Kernel::Point_2(p[(drop + 1) % 3], p[(drop + 2) % 3]);
    };
    return static_cast<int>(CGAL::orientation(flat(i), flat(j), flat(k)));
  };
  int drop = 0;
  while (turn(drop, triple[0], triple[1], triple[2]) == 0) ++drop;
  reversed = turn(drop, triple[0], triple[1], triple[2]) < 0;
  const int x = (drop + 1) % 3, y = (drop + 2) % 3;
  std::sort(on.begin(), on.end(), [&](int i, int j) {
    const Point &p = points[static_cast<std::size_t>(i)], &q = points[static_cast<std::size_t>(j)];
    return std::pair(p[x], p[y]) < std::pair(q[x], q[y]);
  });
  std::vector<int> chain;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = chain.size();
    for (const int v : on) {
      while (chain.size() >= start + 2 &&
             turn(drop, chain[chain.size() - 2], chain.back(), v) <= 0) {
        chain.pop_back();
      }
      chain.push_back(v);
    }
    chain.pop_back();
    std::reverse(on.begin(), on.end());
  }
  return chain;
}

}  // namespace

Convex convex_hull(const std::vector<Vec3>& given) {
  std::vector<Vec3> distinct;
  for (const Vec3& v : given) {
    if (!v.allFinite()) throw InvalidInput("vertices", "not finite", "must be finite");
    if (std::find(distinct.begin(), distinct.end(), v) == distinct.end()) distinct.push_back(v);
  }
  std::vector<Point> points;
  for (const Vec3& v : distinct) points.emplace_back(v.x(), v.y(), v.z());
  const int count = static_cast<int>(points.size());
  std::set<std::vector<int>> known;
  std::vector<std::vector<int>> faces;
  const auto at = [&](int i) -> const Point& { return points[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      for (int k = j + 1; k < count; ++k) {
        if (CGAL::collinear(at(i), at(j), at(k))) continue;
        std::vector<int> on;
        bool above = false, below = false;
        for (int v = 0; v < count && !(above && below); ++v) {
          const int s = side(at(i), at(j), at(k), at(v));
          if (s > 0) above = true;
          if (s < 0) below = true;
          if (s == 0) on.push_back(v);
        }
        if ((above && below) || !known.insert(on).second) continue;
        bool reversed = false;
        std::vector<int> face = polygon(points, on, reversed, {i, j, k});
        if (reversed) std::reverse(face.begin(), face.end());
        // Counterclockwise as i, j, k, which is seen from outside if all others are below.
        if (above) std::reverse(face.begin(), face.end());
        faces.push_back(face);
        if (!above && !below) {
          std::reverse(face.begin(), face.end());
          faces.push_back(face);
        }
      }
    }
  }
  if (faces.empty()) {
    throw InvalidInput("vertices", std::to_string(given.size()) + " points on one line",
                       "must have three that are not on one line");
  }
  std::vector<int> index(distinct.size(), -1);
  std::vector<Vec3> vertices;
  std::set<int> used;
  for (const auto& face : faces) used.insert(face.begin(), face.end());
  for (const int v : used) {
    index[static_cast<std::size_t>(v)] = static_cast<int>(vertices.size());
    vertices.push_back(distinct[static_cast<std::size_t>(v)]);
  }
  for (auto& face : faces) {
    for (int& v : face) v = index[static_cast<std::size_t>(v)];
  }
  return {std::move(vertices), std::move(faces)};
}

}  // namespace touchstone::oracle
