#pragma once

#include <array>
#include <cassert>
#include <span>

#include "pose.hpp"
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
  /// Moves the points by a vector and makes them deeper; leaves out those that are no farther than
  /// `same` from one before.
  void shift_points(const Vec3& by, double deeper, double same);

 private:
  std::array<ContactPoint, max_points> points_;
  std::size_t count_ = 0;
};

// The four questions of a cylinder A and another body B. Lengths in metres, positions and normals
// in the world frame; a normal is a unit vector that points from B to A. Each pair has a file of
// its own, which says at its top which normals may have the largest gap, and in which order they
// are tried; contact_of.hpp asks of a configuration, batch.hpp of many poses.
//
//   B         defined in             signed_distance  contact: apart, overlapping
//   Plane     cylinder_plane.cpp     6 ns             12 ns
//   Sphere    cylinder_sphere.cpp    9 ns             10 ns
//   Capsule   cylinder_capsule.cpp   40 to 70 ns      40 ns, 90 ns
//   Cylinder  cylinder_cylinder.cpp  50 to 500 ns     60 ns, 150 to 500 ns (most where rims meet)
//   Box       cylinder_box.cpp       70 to 250 ns     70 ns, 150 to 300 ns
//   Convex    cylinder_convex.cpp    160 to 1000 ns   100 to 280 ns, 210 to 1200 ns (by vertices)
//
// Where normals tie, the first in a fixed order is taken: of a sphere whose centre is on the axis,
// or as near to a cap as to the side, the cap's, and off the axis local x. Exchanged cylinders have
// the same distance and points and the opposite normal, bit for bit.

/// Returns the signed distance and its normal, however far apart the bodies are; zero where they
/// touch. Within 1e-13 of the larger size of the truth, for every pose; of planes and spheres to a
/// few ulp of the lengths and positions (accuracy_test.cpp).
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                               const Pose& pose_b);
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                               const Pose& pose_b);
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Capsule& b,
                               const Pose& pose_b);
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                               const Pose& pose_b);
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                               const Pose& pose_b);
SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Convex& b,
                               const Pose& pose_b);

/// Returns the same with a bound of its error: tries every kind of normal and searches all rims,
/// whatever proves itself on the way (proofs.md). The bound is rounding where that is proven
/// complete, as it always is but of two cylinders; there it may be larger
/// (certified_distance_test.cpp). Some 2 µs of two cylinders.
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                                     const Pose& pose_b);
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Sphere& b,
                                     const Pose& pose_b);
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Capsule& b,
                                     const Pose& pose_b);
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                                     const Pose& pose_b);
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Box& b,
                                     const Pose& pose_b);
CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Convex& b,
                                     const Pose& pose_b);

/// Returns whether the bodies share a point; those that touch do, as far as rounding can tell.
bool overlaps(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b);
bool overlaps(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b);
bool overlaps(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b);
bool overlaps(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b);
bool overlaps(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b);
bool overlaps(const Cylinder& a, const Pose& pose_a, const Convex& b, const Pose& pose_b);

/// Returns signed distance, normal and points where the distance is at most `contact_threshold`;
/// else no points, as soon as a direction proves it larger, and the clearance along that. README.md
/// says how many points there are and where; the deepest has the whole depth
/// (point_contract_test.cpp). Given `previous_normal`, of the normals whose gaps are within the
/// threshold of the largest the one nearest to it is taken; a plane has one normal only.
Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);
Contact contact(const Cylinder& a, const Pose& pose_a, const Sphere& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);
Contact contact(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);
Contact contact(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);
Contact contact(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);
Contact contact(const Cylinder& a, const Pose& pose_a, const Convex& b, const Pose& pose_b,
                double contact_threshold, const Vec3* previous_normal = nullptr,
                PointRange range = PointRange::near_deepest);

}  // namespace touchstone
