#pragma once

#include <vector>

#include "oracle/patch/convex_set.hpp"
#include "oracle/truth.hpp"

namespace touchstone::oracle {

/// The contact patch of two bodies along a normal: the overlap of their support features in the
/// plane perpendicular to it, halfway between the two surfaces. A point, a segment, or a convex
/// region bounded by lines and circular arcs; not empty. World coordinates, metres.
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
  double perimeter() const {
    return shape_.perimeter();
  }  ///< for a segment its length, counted once
  Vec3 centroid() const { return in_world(shape_.centroid()); }
  /// Width of the patch along a unit direction: max − min of x·direction.
  double extent(const Vec3& direction) const;
  /// Distance from the patch of a point's projection along the normal; zero inside.
  double distance(const Vec3& point) const { return shape_.distance(in_plane(point)); }
  /// The boundary in order, for drawing; arcs as chords, at least `per_quarter` in a quarter turn.
  std::vector<Vec3> outline(int per_quarter = 8) const;

  /// The same patch with all lengths times a power of two.
  ContactPatch scaled(int exponent) const;

  /// The patch in coordinates of its plane.
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
/// the normal's exact alignment. Cylinder: a cap (normal along the axis), a generator
/// (perpendicular to it) or a rim point; capsule: a segment or a point; sphere: a point; box: a
/// face, an edge or a vertex; plane: all of it.
///
/// Every overlap larger than a point is decided in rational coordinates: two caps by the squared
/// distance of their axes, a cap or a generator on a face along the box's axes, all overlaps with a
/// generator or an edge along it. So degenerate poses (tangent discs, a generator that ends on a
/// rim, a rim through a corner) are decided exactly; only lengths and points are then rounded to
/// double.
///
/// A point feature's patch is that point (for two, the point halfway between them), even if
/// rounding puts it beside the other feature. If doubles do not determine the point (an irrational
/// normal that is nearly aligned with an axis, or one aligned only up to rounding), the patch is
/// the centroid of the overlap within rounding of the support planes.
ContactPatch contact_patch(const Configuration& configuration, const OptimalNormal& normal);

/// The ε-patch, for tilted poses: the overlap, seen along n, of the parts of both bodies within
/// `epsilon` metres of their own support planes along the unit vector n from B to A. It contains
/// the exact patch and shrinks to it with epsilon. Curves are replaced by inscribed polygons, which
/// makes each part narrower by less than 0.5% in any direction. Parts that overlap by no more than
/// rounding (n is not optimal) give the point halfway between them. A plane counts as a whole,
/// whatever n is. Precondition: epsilon > 0.
ContactPatch contact_patch(const Configuration& configuration, const Vec3& n, double epsilon);

}  // namespace touchstone::oracle
