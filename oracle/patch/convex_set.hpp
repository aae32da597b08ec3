#pragma once

#include <numbers>
#include <vector>

#include <Eigen/Core>

namespace touchstone::oracle {

using Vec2 = Eigen::Vector2d;

inline constexpr double pi = std::numbers::pi;

/// A piece of a convex boundary with the set on its left: a line, or a counterclockwise arc about a
/// centre.
struct BoundaryPiece {
  Vec2 from, to;
  Vec2 centre = Vec2::Zero();
  double radius = 0;  ///< zero: a line
  double start = 0;   ///< polar angle of `from` about the centre, radians
  double sweep = 0;   ///< in (0, 2π]; 2π is the whole circle

  static BoundaryPiece line(const Vec2& from, const Vec2& to) { return {from, to}; }
  static BoundaryPiece arc(const Vec2& centre, double radius, double start, double sweep);
  bool is_line() const { return radius == 0; }
};

/// A bounded convex set of the plane, not empty: a point, a segment, or a region bounded by lines
/// and circular arcs.
class ConvexSet {
 public:
  enum class Kind { point, segment, region };

  static ConvexSet point(const Vec2& p);
  static ConvexSet segment(const Vec2& from, const Vec2& to);
  /// Takes a closed counterclockwise boundary. Precondition: the region is the intersection of the
  /// half-planes left of its lines and the discs of its arcs.
  static ConvexSet region(std::vector<BoundaryPiece> sides);
  /// Takes counterclockwise vertices without repetition: three or more make a region, fewer a
  /// segment or a point.
  static ConvexSet polygon(const std::vector<Vec2>& vertices);

  Kind kind() const { return kind_; }
  /// The sides of a region in order; for a segment or a point one line, the set itself.
  const std::vector<BoundaryPiece>& sides() const { return sides_; }

  double area() const;
  double perimeter() const;                     ///< for a segment its length, counted once
  Vec2 centroid() const;                        ///< centre of area; for a segment its middle
  double support(const Vec2& direction) const;  ///< max of x·direction
  double distance(const Vec2& p) const;         ///< to the set; zero inside
  /// The boundary as points in order; arcs as chords of at most 90°/per_quarter.
  std::vector<Vec2> outline(int per_quarter) const;
  /// The same set with all lengths times a power of two.
  ConvexSet scaled(int exponent) const;

 private:
  ConvexSet(Kind kind, std::vector<BoundaryPiece> sides) : kind_(kind), sides_(std::move(sides)) {}
  bool contains(const Vec2& p) const;
  Kind kind_;
  std::vector<BoundaryPiece> sides_;
};

// Convex polygons as their vertices, counterclockwise. Two vertices are a segment, one is a point.

/// Vertices of the convex hull; points collinear with their neighbours are dropped exactly.
/// Precondition: there is at least one point.
std::vector<Vec2> plane_hull(const std::vector<Vec2>& points);

/// Intersection of two convex polygons in double: empty if they miss each other, and possibly if
/// the intersection is thinner than rounding.
std::vector<Vec2> intersection(const std::vector<Vec2>& p, const std::vector<Vec2>& q);

/// The point halfway between the nearest points of two convex polygons that do not meet, or cross
/// in less than rounding.
Vec2 halfway(const std::vector<Vec2>& p, const std::vector<Vec2>& q);

}  // namespace touchstone::oracle
