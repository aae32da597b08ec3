#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

namespace touchstone {

using Vec3 = Eigen::Vector3d;
struct ConvexTables;  // convex_tables.hpp

// Shapes, each in its own body frame. Lengths are in metres. A constructor throws InvalidInput
// when a size is NaN, infinite, zero or negative. A disc (half_length 0) and a segment (radius 0)
// are refused like every other zero size: they have no interior, so penetration has no meaning.
//
// A rounding rounds edges and corners by a ball of that radius: the body is all points within it
// of a core. Cylinder and box keep their outer sizes, so that the core's are smaller by the
// rounding, which is at most the smallest of them: a core may be a disc, a segment or a point. A
// hull is the core itself, and the body larger by the rounding: what is left of a hull when all of
// its faces move inward has corners that no doubles hold, and of a polygon nothing is left.

/// The half-space normal·x <= displacement, in the body frame. The normal needs no unit length;
/// it must not be zero.
class Plane {
 public:
  Plane(const Vec3& normal, double displacement);
  const Vec3& normal() const { return normal_; }
  double displacement() const { return displacement_; }
  /// The same in double precision with a normal of unit length; what overflows is the largest
  /// double.
  const Vec3& unit_normal() const { return unit_normal_; }
  double unit_displacement() const { return unit_displacement_; }

 private:
  Vec3 normal_, unit_normal_;
  double displacement_, unit_displacement_;
};

class Sphere {
 public:
  explicit Sphere(double radius);
  double radius() const { return radius_; }

 private:
  double radius_;
};

/// All points within `radius` of the segment from -half_length to +half_length on the local z
/// axis; its ends reach half_length + radius.
class Capsule {
 public:
  Capsule(double radius, double half_length);
  double radius() const { return radius_; }
  double half_length() const { return half_length_; }

 private:
  double radius_;
  double half_length_;
};

/// Solid circular cylinder about the local z axis; the caps are at z = ±half_length.
class Cylinder {
 public:
  Cylinder(double radius, double half_length, double rounding = 0);
  double radius() const { return radius_; }
  double half_length() const { return half_length_; }
  double rounding() const { return rounding_; }
  /// Those of the core, rounded to doubles.
  double core_radius() const { return radius_ - rounding_; }
  double core_half_length() const { return half_length_ - rounding_; }
  /// The same made positive, as routines divide by them: zero is 1e-15 of the body's lengths, which
  /// moves no distance by more than rounding does.
  double positive_core_radius() const { return positive_core_radius_; }
  double positive_core_half_length() const { return positive_core_half_length_; }

 private:
  double radius_;
  double half_length_;
  double rounding_;
  double positive_core_radius_;
  double positive_core_half_length_;
};

class Box {
 public:
  explicit Box(const Vec3& half_extents, double rounding = 0);
  const Vec3& half_extents() const { return half_extents_; }
  double rounding() const { return rounding_; }
  /// Those of the core, rounded to doubles.
  Vec3 core_half_extents() const { return half_extents_.array() - rounding_; }
  /// The same made positive, as a cylinder's.
  const Vec3& positive_core_half_extents() const { return positive_core_half_extents_; }

 private:
  Vec3 half_extents_;
  double rounding_;
  Vec3 positive_core_half_extents_;
};

/// A convex polyhedron with its vertices in the body frame, which need not be about the origin; or
/// a convex polygon in space, as a triangle, which has two faces that look in opposite directions.
/// Copies share what they hold. What it says of vertices and sizes is the hull's, without its
/// rounding.
///
/// The faces are given, because only exact arithmetic finds them for certain (oracle/hull.hpp does,
/// of any points): all vertices of a plane face are in one face, and every vertex is a corner.
class Convex {
 public:
  static constexpr std::size_t max_vertices = 4096;

  struct Face {
    /// Counterclockwise seen from outside; at least three.
    std::vector<int> vertices;
    /// Unit, outward, to within rounding of the vertices: of a sliver it is uncertain.
    Vec3 normal;
  };
  struct Edge {
    /// The first face has them in this order, the second in the other.
    std::array<int, 2> vertices, faces;
  };

  /// `faces` are indices of vertices, counterclockwise seen from outside. Throws InvalidInput
  /// unless there are 3 to max_vertices finite vertices, each of them in a face, the faces have at
  /// least three different ones each and close (every edge has two faces, which run through it in
  /// opposite directions; vertices - edges + faces = 2), and no vertex is outside a face by more
  /// than rounding; and for a rounding that is negative or not finite.
  Convex(std::vector<Vec3> vertices, std::vector<std::vector<int>> faces, double rounding = 0);

  const std::vector<Vec3>& vertices() const { return data_->vertices; }
  const std::vector<Face>& faces() const { return data_->faces; }
  const std::vector<Edge>& edges() const { return data_->edges; }
  /// The faces as engines take them: of each the number of its vertices, and then these.
  const std::vector<int>& face_list() const { return data_->face_list; }
  /// A polygon: without an interior.
  bool is_flat() const { return faces().size() == 2; }
  /// Half of the widths along the local axes, and the middle between them.
  const Vec3& half_extents() const { return data_->half_extents; }
  const Vec3& middle() const { return data_->middle; }
  /// Half of the smallest width over the local axes; of a polygon, half the side of a square of its
  /// area.
  double smallest_half_extent() const { return data_->smallest_half_extent; }
  double rounding() const { return rounding_; }
  /// The same hull with another rounding. Throws as the constructor does.
  Convex rounded(double rounding) const;
  /// The same body with all lengths times a power of two.
  Convex scaled(int exponent) const;
  /// What our routine looks up.
  const ConvexTables& tables() const { return *data_->tables; }

 private:
  struct Data {
    std::vector<Vec3> vertices;
    std::vector<Face> faces;
    std::vector<Edge> edges;
    std::vector<int> face_list;
    Vec3 half_extents, middle;
    double smallest_half_extent;
    std::shared_ptr<const ConvexTables> tables;
  };
  Convex(std::shared_ptr<const Data> data, double rounding)
      : data_(std::move(data)), rounding_(rounding) {}
  std::shared_ptr<const Data> data_;
  double rounding_;
};

using Shape = std::variant<Cylinder, Plane, Sphere, Capsule, Box, Convex>;

/// Name as in files: "cylinder", "plane", "sphere", "capsule", "box", "convex".
const char* shape_name(const Shape& shape);

/// The rounding of a cylinder, box or convex body; that of others is zero.
double rounding_of(const Shape& shape);
/// The same cylinder, box or convex body with another rounding; others as they are. Throws as their
/// constructors do.
Shape with_rounding(const Shape& shape, double rounding);

/// Half of the shape's smallest (largest) width over its own axes, in metres. A plane has none:
/// the smallest is infinite and the largest zero, so that it never decides a minimum or maximum. A
/// sum of two lengths that overflows is the largest double. Of a polygon in space the smallest is
/// half the side of a square of its area, with its rounding.
double smallest_half_extent(const Shape& shape);
double largest_half_extent(const Shape& shape);
inline double largest_half_extent(const Sphere& s) { return s.radius(); }
inline double largest_half_extent(const Capsule& s) {
  return std::min(s.half_length() + s.radius(), std::numeric_limits<double>::max());
}
inline double largest_half_extent(const Cylinder& s) {
  return s.radius() > s.half_length() ? s.radius() : s.half_length();
}
inline double largest_half_extent(const Box& s) { return s.half_extents().maxCoeff(); }
inline double largest_half_extent(const Convex& s) {
  return std::min(s.half_extents().maxCoeff() + s.rounding(), std::numeric_limits<double>::max());
}

}  // namespace touchstone
