#pragma once

#include "properties/draw.hpp"
#include "properties/modifiers.hpp"
#include "properties/moves.hpp"

namespace touchstone {

/// A rotated frame in which bodies can be exactly parallel, perpendicular or touching.
///
/// For an integer quaternion q the axes R(q)|q|² are integers of length N = |q|². Lengths are
/// multiples of N·2^-p and positions are sums of integer multiples of (axis·2^-p): both are doubles
/// without rounding, and a step of m along an axis has exactly the length of a size m.
class Lattice {
 public:
  /// A random frame, or the world's own where it is to be aligned.
  explicit Lattice(Draw& draw, Frame frame = Frame::usual);

  /// Steps per length of about one metre; sizes are drawn from [0.2, 1] of it.
  static constexpr std::int64_t metre = std::int64_t{1} << 25;
  std::int64_t draw_size(Draw& draw) const { return draw.integer(metre / 5, metre); }

  double length(std::int64_t steps) const;
  /// The point at this number of steps along each of the frame's axes.
  Vec3 at(std::int64_t x, std::int64_t y, std::int64_t z) const;
  /// The frame's orientation times an integer quaternion.
  Eigen::Quaterniond orientation(const Eigen::Quaterniond& turn = {1, 0, 0, 0}) const;

 private:
  Eigen::Quaterniond q_;
  double norm_;   // |q|²
  double scale_;  // 2^-p
};

// Bodies on a Lattice: every length and position is a whole number of its steps.

using Steps = std::int64_t;
using Quaternion = Eigen::Quaterniond;

/// Sizes in steps. For a box and a hull radius_b, other_b and half_b are the half extents; for a
/// sphere only radius_b counts; a plane has none. A hull is a box with corners cut off, or holds
/// the middle section of one if it is a triangle, whose half_b is zero.
struct Sizes {
  Steps radius_a, half_a;
  Steps radius_b, half_b, other_b;
  HullForm hull = HullForm::usual;
};
Sizes draw_sizes(Draw& draw, const Lattice& lattice, const Modifiers& modifiers);

/// A uniform whole number from -max to max.
Steps draw_offset(Draw& draw, Steps max);

/// The overlap in steps: usually 1e-6 to 5% of the smallest size; negative where the bodies are to
/// be apart.
Steps draw_depth(Draw& draw, const Sizes& sizes, Clearance clearance);

/// B's reach along its own z beyond its centre.
Steps reach_b(Pair pair, const Sizes& sizes);

/// Position of A's centre relative to B's, and both orientations within the lattice.
struct Placement {
  Steps x, y, z;
  Quaternion turn_b = upright;
  Quaternion turn_a = upright;
};

/// Makes the configuration. B lies a random number of whole steps from the world's origin, so that
/// positions are exact and not zero. A plane is the lattice's z <= 0, shifted likewise.
Configuration place(Draw& draw, Pair pair, const Lattice& lattice, const Sizes& sizes,
                    const Placement& placement);

}  // namespace touchstone
