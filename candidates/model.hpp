#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "candidates/ts_shape.hpp"

namespace touchstone {

using Vec3 = Eigen::Vector3d;

/// All points within `radius` of a core: a point, a segment, a box, a right prism or a hull.
/// Simplified models, and what they meet, consist of these. Precondition of all queries: `place`
/// has been called.
class RoundedPolytope {
 public:
  static RoundedPolytope sphere(const Vec3& centre, double radius);
  /// The core is the segment from −half_length to half_length along local z; half_length 0 is a
  /// sphere.
  static RoundedPolytope capsule(double radius, double half_length);
  static RoundedPolytope box(const Vec3& half_extents);
  /// The core is the prism between z = ±half_length over a regular polygon with `sides` corners on
  /// the circle of that radius, the first on +x.
  static RoundedPolytope prism(int sides, double radius, double half_length);
  /// The core is a convex body of the C interface.
  static RoundedPolytope hull(const ts_shape& convex);

  void place(const Eigen::Matrix3d& rotation, const Vec3& position);

  double radius() const { return radius_; }

  // The core, in the world.
  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Vec3>& normals() const {
    return normals_;
  }  ///< of its faces; one of each pair ±n
  const std::vector<Vec3>& edge_directions() const { return edge_directions_; }
  const std::vector<std::pair<int, int>>& edges() const {
    return edges_;
  }                                                  ///< as indices of vertices
  bool is_solid() const { return !faces_.empty(); }  ///< or a polygon
  const Vec3& support(const Vec3& n) const;          ///< the vertex furthest along n
  Vec3 closest_to(const Vec3& p) const;              ///< for a solid core; inside it, p itself

 private:
  struct Face {
    std::vector<int> corners;  ///< counterclockwise seen from outside
    Vec3 normal;               ///< outward, in the core's frame
  };
  void add_faces(const std::vector<std::vector<int>>& faces);

  double radius_ = 0;
  std::vector<Face> faces_;  ///< two of a polygon
  std::vector<Vec3> local_vertices_, local_normals_, local_edge_directions_;
  std::vector<std::pair<int, int>> edges_;
  std::vector<Vec3> vertices_, normals_, edge_directions_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Vec3 position_ = Vec3::Zero();
};

/// Signed distance and witness points of two bodies.
struct Separation {
  double distance;  ///< signed, metres
  Vec3 normal;      ///< unit, from B to A
  Vec3 on_a, on_b;  ///< witness points, `distance` apart along the normal
};

/// Exact up to rounding, except for separate solid cores. Overlapping cores: the largest gap over
/// face normals and cross products of edges, which are the facet normals of the Minkowski
/// difference of two polytopes (Ericson, Real-Time Collision Detection, 5.2.1). Separate cores: the
/// closest pair of features; for two solid cores only the largest gap, a lower bound if two
/// vertices, or a vertex and an edge, are closest.
Separation separation(const RoundedPolytope& a, const RoundedPolytope& b);

/// Separation from a half-space as body B, solid where normal·x <= displacement.
Separation separation(const RoundedPolytope& a, const Vec3& normal, double displacement);

Eigen::Matrix3d rotation_of(const ts_pose& pose);
Vec3 position_of(const ts_pose& pose);

/// Makes the parts that represent a cylinder of that radius and half length, in its frame.
using CylinderModel =
    std::function<std::vector<RoundedPolytope>(double radius, double half_length)>;

/// Two shapes in which every cylinder is replaced by its model; other shapes are kept.
class ModelPair {
 public:
  ModelPair(const ts_shape& a, const ts_shape& b, const CylinderModel& model);

  /// The smallest separation of a part of A and a part of B. Appends to `all`, if given, that of
  /// every part of A and the part of B closest to it.
  Separation separation(const ts_pose& a, const ts_pose& b, std::vector<Separation>* all = nullptr);

 private:
  std::vector<RoundedPolytope> a_, b_;
  ts_shape plane_{};
  bool is_plane_;
};

/// The largest capsule of the cylinder's length inside it; its radius is at most the half length.
std::vector<RoundedPolytope> inscribed_capsule(double radius, double half_length);
/// A capsule of the cylinder's radius whose segment is the cylinder's axis: the cylinder lies
/// inside.
std::vector<RoundedPolytope> circumscribed_capsule(double radius, double half_length);
/// Spheres inside the cylinder: in a row along the axis if it is longer than wide, otherwise on the
/// widest possible ring, beginning on +x.
std::vector<RoundedPolytope> inscribed_spheres(int count, double radius, double half_length);
/// The prism with its corners on the rims.
std::vector<RoundedPolytope> inscribed_prism(int sides, double radius, double half_length);

/// Spheres or capsules inside a box, of its smallest half extent, in the box's frame. All reach its
/// faces; its edges and corners are lost.
struct BoxParts {
  std::vector<Vec3> centres;
  double radius, half_length;  ///< half_length 0: spheres
  Eigen::Quaterniond along;    ///< rotates a capsule's z to the longest axis
};
/// `count` spheres along the longest axis, in enough rows along the middle one that gaps there are
/// no wider.
BoxParts spheres_in_box(const Vec3& half_extents, int count);
/// `count` capsules along the longest axis, side by side along the middle one.
BoxParts capsules_in_box(const Vec3& half_extents, int count);

}  // namespace touchstone
