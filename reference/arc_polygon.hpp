#pragma once

#include <algorithm>
#include <array>

#include "curves.hpp"

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

/// The points of a plane with |across·p − middle| <= half_width: what lies between two opposite
/// edges of a face.
struct Strip {
  Vec2 across;
  double middle, half_width;
};

/// What a disc shares with the part of a face that lies between its edges, a contact patch: a
/// convex region of a plane, bounded counter-clockwise by straight edges and by arcs of the circle.
/// Fixed size, no allocation.
class ArcPolygon {
 public:
  /// A part of a circle that is no farther than this from its end is not cut off, in radii.
  static constexpr double sliver = 1e-12;

  /// The strips' `across` are unit vectors and nearly at right angles, as those of a face are that
  /// leans by no more than counts as facing (`facing_part`). A sliver thinner than `uncut`, in
  /// radii, is not cut off by one edge alone.
  ArcPolygon(const Circle& circle, const Strip& first, const Strip& second, double uncut = sliver);
  ArcPolygon(const ArcPolygon&) = delete;
  ArcPolygon& operator=(const ArcPolygon&) = delete;

  bool empty() const { return count_ == 0 && !is_disc_; }
  /// The points that are farthest along and against a direction.
  struct Extremes {
    Vec2 top, bottom;
  };
  Extremes extremes(const Vec2& unit) const;
  /// The point that is farthest along a direction (of any length, not zero).
  Vec2 farthest(const Vec2& direction) const { return extremes(direction.normalized()).top; }

  /// Points whose hull covers the region well: the corners, and on arcs as many more as leave no
  /// piece above 72° and, while there are fewer than six, none that stands out by more than a
  /// seventh of the region's width. A full disc gives three, 120° apart. The first is the farthest
  /// along `first`. Never more than eight. Returns how many.
  int spread(const Vec2& first, std::array<Vec2, 8>& points) const;

 private:
  enum Side { straight, round };
  struct Vertex {
    Vec2 at;
    Side side;  ///< the one that leaves it
  };

  static constexpr int max_vertices = 8;  // the ends of four edges

  /// Leaves out edges of this length and less.
  void merge_closer_than(double distance);

  int next(int i) const { return i + 1 < count_ ? i + 1 : 0; }

  Circle circle_;
  std::array<Vertex, max_vertices> vertices_;
  int count_ = 0;
  bool is_disc_ = false;  ///< then it has no vertices
};

}  // namespace touchstone
