#pragma once

#include <vector>

#include "oracle/optimal_normal.hpp"
#include "oracle/patch/convex_set.hpp"

namespace touchstone::oracle {

/// Where two bodies meet along a normal: the part of the plane across it that their support
/// features share. The plane lies halfway between the two surfaces. A point, a segment, or a convex
/// region bounded by lines and circular arcs; never empty. World coordinates, metres.
class ContactPatch {
 public:
  using Kind = ConvexSet::Kind;
  /// The plane through `origin` along the unit vectors e1 and e2; (e1, e2, normal) is right-handed.
  struct Plane {
    Vec3 origin, e1, e2;
  };
  ContactPatch(const Plane& plane, ConvexSet shape) : plane_(plane), shape_(std::move(shape)) {}

  Kind kind() const { return shape_.kind(); }
  double area() const { return shape_.area(); }
  double perimeter() const { return shape_.perimeter(); }  ///< of a segment its length, once
  Vec3 centroid() const { return in_world(shape_.centroid()); }
  /// Width of the patch seen along the plane: max − min of x·direction, for a unit direction.
  double extent(const Vec3& direction) const;
  /// From a point's projection along the normal to the patch; zero inside.
  double distance(const Vec3& point) const { return shape_.distance(in_plane(point)); }
  /// Boundary in order, for drawing; arcs as chords, at least `per_quarter` to a quarter turn.
  std::vector<Vec3> outline(int per_quarter = 8) const;

  /// The same in coordinates of the plane, for whoever measures in it.
  const ConvexSet& shape() const { return shape_; }
  Vec2 in_plane(const Vec3& point) const;
  Vec3 in_world(const Vec2& p) const {
    return plane_.origin + p.x() * plane_.e1 + p.y() * plane_.e2;
  }

 private:
  Plane plane_;
  ConvexSet shape_;
};

/// The patch of a configuration along one of its optimal normals. The support features follow from
/// the normal's exact alignment: of a cylinder its cap (normal along the axis), a generator (across
/// it) or a point of a rim; of a capsule a segment or a point; of a sphere a point; of a box a
/// face, an edge or a vertex; all of a plane.
///
/// Every overlap that is more than a point is decided in rational coordinates: two caps by the
/// squared distance of their axes, a cap or a generator on a face along the box's axes, and
/// whatever meets a generator or an edge along that. So degenerate poses (tangent discs, a
/// generator that ends on a rim, a rim through a corner) are decided exactly; only lengths and
/// points are then rounded to double.
///
/// A point feature's patch is that point (between two, their middle), also where it lies beside the
/// other feature by rounding. Where its doubles cannot tell the point, the patch is the middle of
/// what both bodies have within rounding of their support planes: a normal that is irrational and
/// all but aligned with an axis, or one that is aligned only to rounding.
ContactPatch contact_patch(const Configuration& configuration, const OptimalNormal& normal);

/// The patch of a tilted pose: those parts of both bodies that are within `epsilon` metres of their
/// own support planes along the unit vector n from B to A, seen along n, as far as they overlap. It
/// contains the exact patch and shrinks to it with epsilon. Curves are replaced by inscribed
/// polygons, which makes each body's part narrower by less than 0.5% in any direction. Parts that
/// do not overlap by more than rounding (n is not optimal) give the point halfway between them. A
/// plane counts whole whatever n is. Precondition: epsilon > 0.
ContactPatch contact_patch(const Configuration& configuration, const Vec3& n, double epsilon);

}  // namespace touchstone::oracle
