#pragma once

#include <array>
#include <cmath>

#include "posed_body.hpp"

namespace touchstone {

/// What a body turns towards the other across a known normal.
struct FacingFeature {
  enum class Kind {
    point,
    segment,   ///< a generator or an edge: middle, axis, half_length; radius of curvature across it
    disc,      ///< a cap: middle, axis (its normal), radius
    rectangle  ///< a face: middle, axis (its normal), two sides with their half lengths
  };
  Kind kind;
  Vec3 middle;  ///< The point itself; on the surface.
  /// Of a point on a rim, how much of the normal tells where on the rim it lies; else 1.
  double sine;
  // What the kind has not stays unset.
  Vec3 axis;
  Vec3 mark;  ///< of a disc, across its axis: a direction that turns with the body
  double half_length, radius;
  std::array<Vec3, 2> side;
  std::array<double, 2> half_side;
};

/// Does a tenth of a feature of this half length, leaning by `sine`, rise by no more than `slack`?
/// Features smaller than the slack may lean by a tenth.
inline bool lies_flat(double half_length, double sine, double slack, double most = 0.1) {
  return 0.2 * half_length * std::abs(sine) <= slack && std::abs(sine) <= most;
}

/// The feature of the body that is farthest along `outward`. A cap, generator, edge or face counts
/// as facing when at least a tenth of it lies within `slack` metres of its farthest point.
FacingFeature facing(const PosedCylinder& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedCapsule& body, const Vec3& outward, double slack);
FacingFeature facing(const PosedBox& body, const Vec3& outward, double slack);

/// The one point of a body that is farthest along `outward`, as rounding has it.
struct SupportPoint {
  Vec3 position;
  double sharpness;  ///< how far along `outward` it lies beyond the body's other points, metres
};
SupportPoint support_point(const PosedCylinder& body, const Vec3& outward);
SupportPoint support_point(const PosedCapsule& body, const Vec3& outward);
SupportPoint support_point(const PosedBox& body, const Vec3& outward);

}  // namespace touchstone
