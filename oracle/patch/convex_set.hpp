#pragma once

#include <vector>

#include <Eigen/Core>

namespace touchstone::oracle {

using Vec2 = Eigen::Vector2d;

/// A piece of a convex boundary, the set on its left: a line, or an arc counterclockwise about a
/// centre.
struct Side {
  Vec2 from, to;
  Vec2 centre = Vec2::Zero();
  double radius = 0;  ///< zero: a line
  double start = 0;   ///< polar angle of `from` about the centre, radians
  double sweep = 0;   ///< in (0, 2π]; 2π is the whole circle

  static Side line(const Vec2& from, const Vec2& to) { return {from, to}; }
  static Side arc(const Vec2& centre, double radius, double start, double sweep);
  bool is_line() const { return radius == 0; }
};

/// A bounded convex set of the plane: a point, a segment, or a region whose boundary consists of
/// lines and circular arcs. Never empty. Lengths are metres where the plane's are.
class ConvexSet {
 public:
  enum class Kind { point, segment, region };

  static ConvexSet point(const Vec2& p);
  static ConvexSet segment(const Vec2& from, const Vec2& to);
  /// Counterclockwise, closed. The region must be what is common to the half-planes left of its
  /// lines and the discs of its arcs.
  static ConvexSet region(std::vector<Side> sides);
  /// Counterclockwise vertices without repetition: a region of three or more, else a segment or a
  /// point.
  static ConvexSet polygon(const std::vector<Vec2>& vertices);

  Kind kind() const { return kind_; }
  /// Of a region in order; of a segment and a point, one line that is the set itself.
  const std::vector<Side>& sides() const { return sides_; }

  double area() const;
  double perimeter() const;                     ///< of a segment its length, once
  Vec2 centroid() const;                        ///< centre of area, of a segment its middle
  double support(const Vec2& direction) const;  ///< max of x·direction
  double distance(const Vec2& p) const;         ///< to the set; zero inside
  /// Points of the boundary in order, arcs in chords of at most a quarter turn over `per_quarter`.
  std::vector<Vec2> outline(int per_quarter) const;

 private:
  ConvexSet(Kind kind, std::vector<Side> sides) : kind_(kind), sides_(std::move(sides)) {}
  bool contains(const Vec2& p) const;
  Kind kind_;
  std::vector<Side> sides_;
};

}  // namespace touchstone::oracle
