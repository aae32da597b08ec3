#pragma once

#include <array>

#include "circle.hpp"

namespace touchstone {

/// What two discs share when neither holds the other.
struct Lens {
  Circle circle1, circle2;
  Vec2 towards;      ///< unit, from circle 1's centre to circle 2's
  Vec2 left, right;  ///< its corners, as seen that way

  /// `apart` is how far the centres are apart, along the unit vector `towards`.
  Lens(const Circle& c1, const Circle& c2, double apart, const Vec2& towards);
  /// The point that is farthest along a unit vector.
  Vec2 farthest(const Vec2& unit) const;
  /// Four points whose hull covers two thirds of the lens in every direction from its centroid.
  std::array<Vec2, 4> spread() const;
};

}  // namespace touchstone
