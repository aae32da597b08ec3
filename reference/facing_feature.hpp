#pragma once

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
  // Members that the kind does not name stay unset.
  Vec3 axis;
  Vec3 mark;  ///< of a disc, across its axis: a direction that turns with the body
  double half_length, radius;
  std::array<Vec3, 2> side;
  std::array<double, 2> half_side;
};

/// Returns whether a tenth of a feature of this half length, leaning by `sine`, rises by no more
/// than `slack`. Features smaller than the slack may lean by `max_sine`.
inline bool lies_flat(double half_length, double sine, double slack, double max_sine = 0.1) {
  return 0.2 * half_length * std::abs(sine) <= slack && std::abs(sine) <= max_sine;
}

/// The feature of the body that is farthest along `outward`. A cap, generator, edge or face counts
/// as facing when at least a tenth of it lies within `slack` metres of its farthest point.
FacingFeature facing(const PosedCylinder& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedCapsule& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedBox& body, const Vec3& outward, double slack);

/// The single farthest point of a body along `outward`, however rounding chooses among several.
struct SupportPoint {
  Vec3 position;
  double sharpness;  ///< how far along `outward` it lies beyond the body's other points, metres
};
SupportPoint support_point(const PosedCylinder& body, const Vec3& outward);
SupportPoint support_point(const PosedCapsule& body, const Vec3& outward);
SupportPoint support_point(const PosedBox& body, const Vec3& outward);

}  // namespace touchstone
