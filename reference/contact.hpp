#pragma once

#include <array>
#include <cassert>
#include <span>

#include "shape.hpp"

namespace touchstone {

/// One point of a contact manifold, in the world frame.
struct ContactPoint {
  Vec3 position;  ///< Halfway between the two surfaces along the contact normal, metres.
  double depth;   ///< Penetration at this point, metres; negative when the surfaces are apart.
};

/// Which places of the features that face each other carry contact points: all are within the
/// contact threshold.
enum class PointRange {
  /// Within a thousandth of the smaller body's largest half extent above the deepest point, so that
  /// the points draw together as a body tilts, and are all on both surfaces.
  near_deepest,
  /// All, while caps, sides and faces lean by at most 0.1: for engines whose bodies sink into one
  /// another, or whose steps are so long that a body rocks from edge to edge. Of round bodies that
  /// lean by θ, points are off the surface by θ²/2 of the size.
  within_threshold
};

/// How far two bodies are apart, and along what.
struct SignedDistance {
  double value;  ///< Metres; positive apart, negative inside (minus the penetration depth).
  Vec3 normal;   ///< Unit, from B to A: the way A moves to come free.
};

/// A signed distance that says how certain it is.
struct CertifiedDistance : SignedDistance {
  /// Metres: the true signed distance of the shapes and poses as they are given, each quaternion
  /// divided by its exact length, lies within `value` ± `error_bound`. Where the search is proven
  /// complete that is rounding, some 1e-14 of all lengths; where it is not, as much larger as the
  /// distance may be, and infinite where the distance overflows.
  double error_bound;
};

/// A routine's answer for one configuration.
class Contact {
 public:
  static constexpr int max_points = 8;

  Vec3 normal;  ///< Unit, from B to A: the way A moves to come free.
  /// Metres; positive apart, negative inside (minus the penetration depth). Where there are no
  /// points it is the clearance along `normal`: above the contact threshold, and not above the
  /// distance.
  double signed_distance;

  /// Empty when the bodies are further apart than the contact threshold.
  std::span<const ContactPoint> points() const { return {points_.data(), count_}; }
  void add_point(const Vec3& position, double depth) {
    assert(count_ < max_points);
    points_[count_++] = {position, depth};
  }
  void clear_points() { count_ = 0; }

 private:
  std::array<ContactPoint, max_points> points_;
  std::size_t count_ = 0;
};

}  // namespace touchstone
