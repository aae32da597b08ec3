#pragma once

#include <array>

#include "curves.hpp"
#include "disc_layout.hpp"

namespace touchstone {

/// What two caps share, a contact patch, and the few points that stand for it; in a plane, as
/// CapOnFace: a disc, for which three points of its rim stand, or a lens, for which four do.
class CapOnCap {
 public:
  /// The first of three points of a whole disc lies along `anchor`.
  CapOnCap(const Circle& c1, const Circle& c2, const Vec2& anchor);

  /// The rims only touch, or do not reach each other.
  bool empty() const { return apart_ >= circle1_.radius + circle2_.radius; }
  /// The middle of the largest disc in the patch. Vectors from here on are arms from there.
  const Vec2& middle() const { return middle_; }
  /// The place of the first cap, or between them, where their rims are nearest to each other.
  Vec2 nearest() const;
  Vec2 farthest(const Vec2& unit, double = 0) const;

  static constexpr int max_points = 8;
  /// As CapOnFace::spread, and as `cut_off` there.
  int spread(const Vec2& towards, const Vec2& deepest, double clearness,
             std::array<Vec2, max_points>& points) const;
  void cut_off(const Vec2& up, double height, std::array<Vec2, max_points>& points,
               int count) const;

 private:
  /// How far a cap leaves the other one, in parts of the smaller radius, until that is clear; and
  /// twice this part further on three points have been handed over to four.
  static constexpr double clear = 1e-6, handed_over = 0.0081;

  /// Points whose hull covers 0.6 of the lens in every direction from its centroid: four,
  /// or five on the way from one way to place four to another. Returns how many.
  int spread_lens(std::array<Vec2, max_points>& points) const;

  Circle circle1_, circle2_;
  double apart_;  ///< how far the centres are
  Vec2 towards_;  ///< unit, from circle 1's centre to circle 2's
  Vec2 middle_, anchor_;
  double radius_;      ///< of the largest disc in the patch
  double along_;       ///< of the middle, from circle 1's centre towards circle 2's
  double chord_;       ///< likewise, of the chord that the circles share
  double missing_;     ///< of the smaller cap's radius, how far the other one leaves it
  HandOver over_;      ///< from three points to four
  Vec2 left_, right_;  ///< corners of the lens, as seen that way
};

}  // namespace touchstone
