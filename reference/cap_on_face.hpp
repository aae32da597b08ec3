#pragma once

#include <array>

#include "curves.hpp"

namespace touchstone {

/// What a cap shares with a face, a contact patch, and the few points that stand for it. Vectors
/// are arms from the cap's middle, in the cap's plane.
///
/// Each of the face's four sides gives one point while it does not cut the cap, and the two ends of
/// what of its edge is in the cap when it does: three points of a whole cap, four of a face within
/// it, five to eight of a cap that one to four edges cut. All of them are continuous functions of
/// where the edges run and of how the cap leans, so that their hull never jumps: they grow out of
/// each other as an edge begins to cut, and where there is no room for a ninth, the two beside the
/// deepest place move there.
class CapOnFace {
 public:
  /// The strips' `across` are unit vectors and nearly at right angles, as those of a face are that
  /// leans by no more than counts as facing (`facing_part`).
  CapOnFace(const Circle& cap, const Strip& first, const Strip& second);

  bool empty() const { return empty_; }
  /// The face's point that is nearest to the cap's middle.
  Vec2 nearest() const;
  /// The place that is farthest along a unit vector; of one that is across an edge but for less
  /// than `straight`, a place on the edge, so that it does not change ends all at once.
  Vec2 farthest(const Vec2& unit, double straight = 0) const;

  static constexpr int max_points = 8;
  /// The points of a cap that leans towards a unit vector, at whose farthest place `deepest` it is
  /// deepest, more or less clearly (`deepest_point_weight`). Returns how many.
  int spread(const Vec2& towards, const Vec2& deepest, double clearness,
             std::array<Vec2, max_points>& points) const;

  /// Moves points that are higher along the unit vector `up` down to that line across it, to where
  /// it runs through the patch.
  void cut_off(const Vec2& up, double height, std::array<Vec2, max_points>& points,
               int count) const;

 private:
  /// A side of the face: its points are z along its outward normal and `lateral` along the next
  /// side's.
  struct Side {
    double distance;  ///< of its edge
    double top;       ///< how far the cap reaches between the two sides beside it
    double height;    ///< how far the patch does
    double lo, hi;    ///< lateral ends of the patch's highest place
  };

  static int next(int i) { return (i + 1) % 4; }
  static int before(int i) { return (i + 3) % 4; }
  double slant(int i) const { return i % 2 == 0 ? cosine_ : -cosine_; }
  Vec2 place(int i, double z, double lateral) const {
    return z * dual_[i] + lateral * dual_[next(i)];
  }
  /// Where the circle is highest at that lateral place.
  double circle_at(int i, double lateral) const;
  Vec2 middle_of(int i) const;

  double radius_;
  std::array<Vec2, 4> outward_;  ///< unit normals, counter-clockwise
  std::array<Vec2, 4> dual_;  ///< has product 1 with its side's normal and 0 with those beside it
  double cosine_, sine_;      ///< between two normals
  std::array<Side, 4> sides_;
  double max_cut_, min_cut_;  ///< how much of the cap a side cuts off, in radii; negative: it is so
                              ///< far away
  bool empty_ = false;
};

}  // namespace touchstone
