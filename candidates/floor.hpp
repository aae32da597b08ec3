#pragma once

#include <array>
#include <vector>

#include "candidates/model.hpp"

namespace touchstone {

/// The surface of a plane or box as triangles, as users of engines make their floors: the same
/// body, but with seams, and with no inside.
///
/// It consists of squares (of a box, rectangles) of two triangles, whose diagonals all go the same
/// way: count × count on each face of a box, and of a plane count × count about the cylinder, five
/// of its bounding radii wide. A plane has no end: at every query the squares are moved by whole
/// ones to where the cylinder is, as a game streams its ground. So seams are where they would be if
/// there were squares everywhere, and the plane's point nearest to its frame's origin is a corner
/// of some.
class Floor {
 public:
  /// Of the plane or box b, for the cylinder a.
  Floor(const ts_shape& a, const ts_shape& b, int count);
  /// Of a box.
  Floor(const Vec3& half_extents, int count);

  /// In the floor's own frame, whose z is the normal of a plane; its xy-plane is the surface then.
  const std::vector<Vec3>& corners() const { return corners_; }
  using Triangle = std::array<int, 3>;
  /// Indices of corners, counterclockwise seen from outside.
  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Where the floor's frame is for bodies at these poses: of a box, its own.
  ts_pose at(const ts_pose& a, const ts_pose& b) const;

  int count() const { return count_; }
  /// Length of a square's side: of a plane.
  double side() const { return side_; }

 private:
  /// Adds the squares of a face about a centre; half its sides are u and v, and u×v looks outside.
  void add_face(const Vec3& centre, const Vec3& u, const Vec3& v);

  int count_;
  bool is_plane_;
  double side_ = 0, displacement_ = 0;
  Eigen::Quaterniond to_normal_ = Eigen::Quaterniond::Identity();  ///< turns z to the normal
  std::vector<Vec3> corners_;
  std::vector<Triangle> triangles_;
};

/// The parameter of candidates with floors.
inline const ts_parameter floor_parameter = {"number of squares along a side", 2, 64, 8, 1, 0};

}  // namespace touchstone
