#pragma once

#include <algorithm>
#include <limits>
#include <variant>

#include <Eigen/Core>

namespace touchstone {

using Vec3 = Eigen::Vector3d;

// Shapes, each in its own body frame. Lengths are in metres. A constructor throws InvalidInput
// when a size is NaN, infinite, zero or negative. A disc (half_length 0) and a segment (radius 0)
// are refused like every other zero size: they have no interior, so penetration has no meaning.

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
  Cylinder(double radius, double half_length);
  double radius() const { return radius_; }
  double half_length() const { return half_length_; }

 private:
  double radius_;
  double half_length_;
};

class Box {
 public:
  explicit Box(const Vec3& half_extents);
  const Vec3& half_extents() const { return half_extents_; }

 private:
  Vec3 half_extents_;
};

using Shape = std::variant<Cylinder, Plane, Sphere, Capsule, Box>;

/// Name as in files: "cylinder", "plane", "sphere", "capsule", "box".
const char* shape_name(const Shape& shape);

/// Half of the shape's smallest (largest) width over its own axes, in metres. A plane has none:
/// the smallest is infinite and the largest zero, so that it never decides a minimum or maximum. A
/// capsule's largest is the largest double where the sum of its two lengths overflows.
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

}  // namespace touchstone
