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
    segment,   ///< a generator or an edge: middle, axis, half_length; radius of curvature across it
    disc,      ///< a cap: middle, axis (its normal or the opposite), radius
    rectangle  ///< a face: middle, axis (likewise), two sides with their half lengths
  };
  Kind kind = Kind::point;
  Vec3 middle;  ///< The point itself; on the surface.
  /// Of a point on a rim, the sine of the angle between normal and axis; otherwise 1.
  double sine;
  double part = 1;  ///< Of a disc its `facing_part`: whole itself, its points are to draw together.
  // Members that the kind does not name stay unset.
  Vec3 axis;
  Vec3 mark;  ///< of a disc, across its axis: a direction that turns with the body
  double half_length, radius;
  std::array<Vec3, 2> side;
  std::array<double, 2> half_side;
  std::array<double, 2> left_out;  ///< how far each side goes on along itself, at its far end
};

/// How large a part of a feature of this half length, which leans by `sine`, faces the other body,
/// from its end that is nearest to it on: all of it while an eighth lies within `slack` of that
/// end, less and less as it leans further, and none (0) where only a tenth does: a can on a slope
/// has to stand as long as it does on paper. Features smaller than the slack may lean by
/// `max_sine`. Continuous, but for parts of a millionth, so that no feature ends to face the other
/// body all at once.
inline double facing_part(double half_length, double sine, double slack, double max_sine = 0.1) {
  const double lean = std::abs(sine), rise = 0.2 * half_length * lean;
  constexpr double all_but_highest = 1.25, all_but_steepest = 0.9, same = 1e-6;
  if (all_but_highest * rise <= slack && lean <= all_but_steepest * max_sine) [[likely]]
    return 1;
  if (!(rise < slack && lean < max_sine)) return 0;
  const double steep = (1 - lean / max_sine) / (1 - all_but_steepest);
  const double part = std::min({(slack / rise - 1) / (all_but_highest - 1), steep, 1.0});
  return part > same ? part : 0;
}

/// The feature of the body that is farthest along `outward`: of a generator, edge or face that
/// leans, its `facing_part`.
FacingFeature facing(const PosedCylinder& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedCapsule& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedBox& body, const Vec3& outward, double slack);

}  // namespace touchstone
