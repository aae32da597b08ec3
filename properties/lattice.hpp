#pragma once

#include "properties/draw.hpp"

namespace touchstone {

/// A turned frame in which parallel, perpendicular and touching bodies are so exactly.
///
/// For an integer quaternion q the axes R(q)|q|² are integers of length N = |q|². Lengths are
/// multiples of N·2^-p and positions are sums of integer multiples of (axis·2^-p): both are doubles
/// without rounding, and a step of m along an axis has exactly the length of a size m.
class Lattice {
 public:
  explicit Lattice(Draw& draw);

  /// Steps to a length of about one metre; sizes are drawn in [0.2, 1] of it.
  static constexpr std::int64_t metre = std::int64_t{1} << 25;
  std::int64_t draw_size(Draw& draw) const { return draw.integer(metre / 5, metre); }

  double length(std::int64_t steps) const;
  /// The point at these steps along the frame's axes.
  Vec3 at(std::int64_t x, std::int64_t y, std::int64_t z) const;
  /// The frame's orientation, turned further within the frame by an integer quaternion.
  Eigen::Quaterniond orientation(const Eigen::Quaterniond& turn = {1, 0, 0, 0}) const;

 private:
  Eigen::Quaterniond q_;
  double norm_;   // |q|²
  double scale_;  // 2^-p
};

}  // namespace touchstone
