#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "shape.hpp"

namespace touchstone {

/// What our routine looks up of a convex body, in the body's frame: made once for each body, so
/// that a question of a pose allocates and normalises nothing.
///
/// Directions are as exact as doubles are, of slivers too: the products of which they are made are
/// exact to twice a double's digits.
struct ConvexTables {
  /// Four vectors at once, component by component; of the last ones the last is repeated.
  using Four = Eigen::Array4d;
  struct Points {
    Four x, y, z;
    Four along(const Vec3& n) const { return x * n.x() + y * n.y() + z * n.z(); }
  };
  struct Planes {
    Points normal;
    Four offset;  ///< the body's support along the normal
    Four heights(const Vec3& p) const { return normal.along(p) - offset; }
  };
  /// An edge, counterclockwise as seen from outside its left face. Its outward normals are those
  /// from the left face's to the right one's, with the middle between them (in a polygon's plane).
  struct Edge {
    Vec3 from, along, middle;
    double length;
    double reach;  ///< the body's support along the middle
    std::array<int, 2> vertices;
    int left, right;
  };
  struct FaceEdge {
    int edge, other;  ///< and the face beyond it
    Vec3 outward;     ///< in the face's plane, across the edge
  };
  /// Faces that lie in one plane but for a hair: what a cap stands on.
  struct Facet {
    std::vector<int> corners;  ///< counterclockwise seen from outside
    std::vector<int> faces;
    Vec3 normal;            ///< outward, of the first face
    double offset;          ///< the body's support along it
    bool is_rough = false;  ///< by more than the rounding of its vertices
  };
  /// By how much of `far` a rough facet's vertices are off its plane, at most: those of a mesh in
  /// single precision are.
  static constexpr double rough_part = 1e-6;
  /// Items of all owners in one list.
  template <class Item>
  struct Lists {
    std::vector<Item> items;
    std::vector<int> first;  ///< of each owner, and the number of all
    std::span<const Item> of(int owner) const {
      return {items.data() + first[owner], items.data() + first[owner + 1]};
    }
  };

  std::vector<Points> vertices;
  std::vector<Planes> faces;
  // The same one by one: what is stored component by component and loaded as a vector stalls.
  std::vector<Vec3> places, face_normals;
  int face_count;
  std::vector<Vec3> face_middles;  ///< of their corners
  std::vector<Edge> edges;
  Lists<FaceEdge> face_edges;
  std::vector<Facet> facets;  ///< plane ones, of each face one, then rough ones of several
  Lists<int> vertex_facets;   ///< plane ones
  Lists<int> vertex_flats;    ///< rough ones, and plane ones that are in none
  Lists<int> vertex_edges;
  double far;  ///< the largest sum of a vertex's coordinates: lengths are rounded as parts of it

  ConvexTables(const std::vector<Vec3>& vertices, const std::vector<Convex::Face>& faces,
               const std::vector<Convex::Edge>& edges);
  /// All lengths times a power of two.
  ConvexTables scaled(int exponent) const;

  double support(const Vec3& n) const {
    Four most = vertices.front().along(n);
    for (std::size_t i = 1; i < vertices.size(); ++i) most = most.max(vertices[i].along(n));
    return most.maxCoeff();
  }
  const Vec3& face_normal(int face) const { return face_normals[static_cast<std::size_t>(face)]; }
  const Vec3& vertex(int i) const { return places[static_cast<std::size_t>(i)]; }
  /// The first of several.
  int farthest_vertex(const Vec3& n) const { return first_at(n, support(n)); }
  /// The first vertex that is as far along n as the body is.
  int first_at(const Vec3& n, double far_along) const {
    std::size_t i = 0;
    Four along = vertices[0].along(n);
    while (i + 1 < vertices.size() && !(along.maxCoeff() >= far_along)) {
      along = vertices[++i].along(n);
    }
    int k = 3;  // branch-free: the winner is unpredictable
    for (int j = 2; j >= 0; --j) k = along[j] >= far_along ? j : k;
    return 4 * static_cast<int>(i) + k;
  }
  /// How far a point lies above a face's plane; with the bits of `heights`.
  double height(const Vec3& p, int face) const {
    const Planes& planes = faces[face / 4];
    const int i = face % 4;
    return planes.normal.x[i] * p.x() + planes.normal.y[i] * p.y() + planes.normal.z[i] * p.z() -
           planes.offset[i];
  }

 private:
  /// Sets what follows from places and directions.
  void measure();
};

}  // namespace touchstone
