#pragma once

#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "candidates/candidate.h"

namespace touchstone {

using Vec3 = Eigen::Vector3d;

/// All points within `radius` of a point, a segment, a box or a right prism: what simplified models
/// are made of. Placed in the world before it is asked for anything.
class RoundedPolytope {
 public:
  static RoundedPolytope sphere(const Vec3& centre, double radius);
  /// Along local z, the segment from −half_length to half_length; a half_length of 0 is a sphere.
  static RoundedPolytope capsule(double radius, double half_length);
  static RoundedPolytope box(const Vec3& half_extents);
  /// The prism over a regular polygon with `sides` corners on the circle of that radius, the first
  /// on +x, between z = ±half_length.
  static RoundedPolytope prism(int sides, double radius, double half_length);

  void place(const Eigen::Matrix3d& rotation, const Vec3& position);

  double radius() const { return radius_; }

  // The core, in the world.
  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Vec3>& normals() const { return normals_; }  ///< of its faces; one of ±n
  const std::vector<Vec3>& edge_directions() const { return edge_directions_; }
  const std::vector<std::pair<int, int>>& edges() const { return edges_; }  ///< by vertices
  bool is_solid() const { return !normals_.empty(); }
  const Vec3& support(const Vec3& n) const;  ///< the vertex furthest along n
  Vec3 closest_to(const Vec3& p) const;      ///< of a solid core, inside it p itself

 private:
  double radius_ = 0;
  std::vector<Vec3> local_vertices_, local_normals_, local_edge_directions_;
  std::vector<std::pair<int, int>> edges_;
  std::vector<Vec3> vertices_, normals_, edge_directions_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Vec3 position_ = Vec3::Zero();
};

/// How two bodies lie to each other.
struct Separation {
  double distance;  ///< signed, metres
  Vec3 normal;      ///< unit, from B to A
  Vec3 on_a, on_b;  ///< a point of each, `distance` apart along the normal
};

/// Exact but for rounding. Overlapping cores: the largest gap over face normals and cross products
/// of edges, the facets of the Minkowski difference of two polytopes (e.g. Ericson, Real-Time
/// Collision Detection, 5.2.1). Apart: the closest pair of features; between two solid cores only
/// the largest gap, a lower bound where two vertices, or a vertex and an edge, are closest.
Separation separation(const RoundedPolytope& a, const RoundedPolytope& b);

/// A half-space, solid where normal·x <= displacement, as body B.
Separation separation(const RoundedPolytope& a, const Vec3& normal, double displacement);

Eigen::Matrix3d rotation_of(const ts_pose& pose);
Vec3 position_of(const ts_pose& pose);

}  // namespace touchstone
