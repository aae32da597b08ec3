// Hulls by exact predicates: CGAL's quickhull triangulates the surface, of which edges between
// triangles in one plane are then taken away, and corners between edges on one line.
#include "oracle/hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/Projection_traits_xz_3.h>
#include <CGAL/Projection_traits_yz_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/ch_graham_andrew.h>
#include <CGAL/convex_hull_3.h>
#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
/// The corners of each face, counterclockwise seen from outside.
using Faces = std::vector<std::vector<Point>>;

Point exact_point(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

bool in_one_plane(const std::vector<Point>& points) {
  const auto third = std::find_if(points.begin() + 1, points.end(), [&](const Point& p) {
    return !CGAL::collinear(points[0], points[1], p);
  });
  return std::all_of(points.begin(), points.end(), [&](const Point& p) {
    return third == points.end() || CGAL::coplanar(points[0], points[1], *third, p);
  });
}

/// Corners of points in one plane, seen along a coordinate; fewer than three if it lies in the
/// plane.
template <class Projection>
std::vector<Point> polygon_corners(const std::vector<Point>& points) {
  std::vector<Point> result;
  CGAL::ch_graham_andrew(points.begin(), points.end(), std::back_inserter(result), Projection());
  return result;
}

/// None of points on one line.
Faces faces_of_polygon(const std::vector<Point>& points) {
  for (std::vector<Point> front : {polygon_corners<CGAL::Projection_traits_xy_3<Kernel>>(points),
                                   polygon_corners<CGAL::Projection_traits_yz_3<Kernel>>(points),
                                   polygon_corners<CGAL::Projection_traits_xz_3<Kernel>>(points)}) {
    if (front.size() > 2) return {front, std::vector<Point>(front.rbegin(), front.rend())};
  }
  return {};
}

Faces faces_of_polyhedron(const std::vector<Point>& points) {
  Mesh mesh;
  CGAL::convex_hull_3(points.begin(), points.end(), mesh);
  const auto apex = [&](Mesh::Halfedge_index h) { return mesh.point(mesh.target(mesh.next(h))); };
  // An edge is one if its triangles are not in one plane, and a corner has three edges or more.
  std::vector<bool> is_edge(mesh.num_halfedges()), seen(mesh.num_halfedges());
  std::vector<int> edges_at(mesh.num_vertices());
  for (const auto h : mesh.halfedges()) {
    is_edge[h] = !CGAL::coplanar(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), apex(h),
                                 apex(mesh.opposite(h)));
    if (is_edge[h]) ++edges_at[mesh.source(h)];
  }
  Faces faces;
  for (const auto first : mesh.halfedges()) {
    if (!is_edge[first] || seen[first]) continue;
    std::vector<Point>& face = faces.emplace_back();
    for (auto h = first; !seen[h];) {
      seen[h] = true;
      if (edges_at[mesh.source(h)] > 2) face.push_back(mesh.point(mesh.source(h)));
      for (h = mesh.next(h); !is_edge[h];) h = mesh.next(mesh.opposite(h));
    }
  }
  return faces;
}

}  // namespace

Convex convex_hull(const std::vector<Vec3>& given, double rounding) {
  std::map<Point, int> index;  // the first of equal ones
  std::vector<Point> points;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i].allFinite()) {
      throw InvalidInput("vertices[" + std::to_string(i) + "]", "not finite", "must be finite");
    }
    const Point p = exact_point(given[i]);
    if (index.emplace(p, static_cast<int>(i)).second) points.push_back(p);
  }
  if (points.size() < 3) {
    throw InvalidInput("vertices", std::to_string(points.size()) + " different points",
                       "must have three that are not on one line");
  }
  const Faces faces = in_one_plane(points) ? faces_of_polygon(points) : faces_of_polyhedron(points);
  if (faces.empty()) {
    throw InvalidInput("vertices", std::to_string(points.size()) + " points on one line",
                       "must have three that are not on one line");
  }

  std::vector<int> rank(given.size(), -1);
  for (const auto& face : faces) {
    for (const Point& p : face) rank[index[p]] = 0;
  }
  std::vector<Vec3> vertices;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (rank[i] < 0) continue;
    rank[i] = static_cast<int>(vertices.size());
    vertices.push_back(given[i]);
  }
  if (vertices.size() > Convex::max_vertices) {
    throw InvalidInput("vertices", std::to_string(vertices.size()) + " corners",
                       "must be at most " + std::to_string(Convex::max_vertices));
  }
  // Each face begins with its first vertex, and the faces are sorted, whatever order CGAL found.
  std::vector<std::vector<int>> indices;
  for (const auto& face : faces) {
    auto& on = indices.emplace_back();
    for (const Point& p : face) on.push_back(rank[index[p]]);
    std::rotate(on.begin(), std::min_element(on.begin(), on.end()), on.end());
  }
  std::sort(indices.begin(), indices.end());
  return {std::move(vertices), std::move(indices), rounding};
}

}  // namespace touchstone::oracle
