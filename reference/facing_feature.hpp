#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "posed_body.hpp"

namespace touchstone {

/// The part of a body's surface that faces the other body across a known normal.
struct FacingFeature {
  enum class Kind {
    point,
    segment,  ///< a generator or an edge: middle, axis, half_length; radius of curvature across it
    disc,     ///< a cap: middle, axis (its normal or the opposite), radius
    rectangle,  ///< a face: middle, axis (likewise), two sides with their half lengths
    polygon     ///< a hull's facet: middle, axis (outward), corners
  };
  Kind kind = Kind::point;
  Vec3 middle;  ///< The point itself; on the surface.
  /// Of a point on a rim, the sine of the angle between normal and axis; otherwise 1.
  double sine;
  double part =
      1;  ///< Of a disc, segment or polygon its `facing_part`; the feature itself is whole.
  // Members that the kind does not name stay unset.
  Vec3 axis;
  Vec3 mark;  ///< of a disc, across its axis: a direction that turns with the body
  double half_length, radius;
  std::array<Vec3, 2> side;
  std::array<double, 2> half_side;
  /// How far each side goes on along itself, at its far end; the first one how much of a segment
  /// does not face the other body.
  std::array<double, 2> left_out;
  const PosedConvex* hull;
  const ConvexTables::Facet* facet;

  int corner_count() const { return static_cast<int>(facet->corners.size()); }
  Vec3 corner(int i) const {
    return hull->centre + hull->axes * hull->body.tables().vertex(facet->corners[i]);
  }
};

/// How large a part of a feature of this half length, which leans by `sine`, faces the other body,
/// from its end that is nearest to it on: all while a tenth of it lies within `slack` of that end
/// (of faces, to which `all_up_to` is 0.5, a fifth), less and less as it leans further, and none
/// (0) where an eleventh does; the same up to `max_sine`, which small features reach first.
/// Continuous, but for parts of a millionth, so that no feature ends to face the other body all at
/// once.
inline double facing_part(double half_length, double sine, double slack, double max_sine = 0.1,
                          double all_up_to = 1) {
  constexpr double none_from = 1.1, same = 1e-6;
  const double lean = std::abs(sine), raised = 0.2 * half_length * lean;
  if (raised >= none_from * slack) return 0;  // as most poses are, before anything is divided
  const double most = std::max(raised / slack, none_from * lean / max_sine);
  if (most <= all_up_to) [[likely]]
    return 1;
  const double part = (none_from - most) / (none_from - all_up_to);
  return part > same ? part : 0;
}

/// The feature of the body that is farthest along `outward`: of a generator, edge or face that
/// leans, its `facing_part`.
FacingFeature facing(const PosedCylinder& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedCapsule& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedBox& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedConvex& body, const Vec3& outward, double slack);

/// Makes the feature a facet, of which one corner is named, or an edge, whichever way they lean.
void set_facet(FacingFeature& feature, const PosedConvex& body, const ConvexTables::Facet& facet,
               int corner);
void set_edge(FacingFeature& feature, const PosedConvex& body, const ConvexTables::Edge& edge);

}  // namespace touchstone
