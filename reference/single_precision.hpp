#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "contact.hpp"
#include "pose.hpp"

namespace touchstone {

// The questions for engines that keep poses and contacts in float. Lengths of shapes are given to
// the constructors of shape.hpp, which hold a float exactly.
//
// Poses are floats and answers are rounded to floats; in between all is double: the proofs by which
// a search ends, and what tells parallel from nearly so, hold for double's rounding and not for
// float's. So an answer is that of the bodies as they are given, to within float's rounding of the
// answer itself: distances and normals to 1e-6 of the larger size, positions to float's rounding of
// their coordinates (accuracy_test.cpp; README.md has the table). It takes longer than in double,
// by the rotation matrix, which a FloatPose, a quarter of the size, does not keep.

/// Position (metres) and orientation of a body, a quaternion of any length but zero.
class FloatPose {
 public:
  FloatPose() = default;
  /// Throws InvalidInput on NaN, infinity or a zero quaternion.
  FloatPose(const Eigen::Vector3f& position, const Eigen::Quaternionf& orientation);

  const Eigen::Vector3f& position() const { return position_; }
  const Eigen::Quaternionf& orientation() const { return orientation_; }
  /// The same, exactly.
  Pose in_double() const { return Pose(position_.cast<double>(), orientation_.cast<double>()); }

 private:
  Eigen::Vector3f position_ = Eigen::Vector3f::Zero();
  Eigen::Quaternionf orientation_ = Eigen::Quaternionf::Identity();
};

/// Members are those of their namesakes in contact.hpp; what overflows is the largest float.
struct FloatSignedDistance {
  float value;
  Eigen::Vector3f normal;
};
struct FloatContactPoint {
  Eigen::Vector3f position;
  float depth;
};
struct FloatContact {
  Eigen::Vector3f normal;
  float signed_distance;
  int point_count;
  std::array<FloatContactPoint, Contact::max_points> all_points;  ///< as many as `point_count`

  std::span<const FloatContactPoint> points() const {
    return {all_points.data(), static_cast<std::size_t>(point_count)};
  }
};

inline float rounded(double x) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -most, most));
}
inline Eigen::Vector3f rounded(const Vec3& x) {
  return {rounded(x.x()), rounded(x.y()), rounded(x.z())};
}
inline void round_into(const SignedDistance& from, FloatSignedDistance& to) {
  to = {rounded(from.value), rounded(from.normal)};
}
void round_into(const Contact& from, FloatContact& to);

// As in contact.hpp. `Other` is Plane, Sphere, Capsule, Cylinder, Box or Convex.

template <class Other>
FloatSignedDistance signed_distance(const Cylinder& a, const FloatPose& pose_a, const Other& b,
                                    const FloatPose& pose_b) {
  FloatSignedDistance result;
  round_into(signed_distance(a, pose_a.in_double(), b, pose_b.in_double()), result);
  return result;
}
template <class Other>
bool overlaps(const Cylinder& a, const FloatPose& pose_a, const Other& b, const FloatPose& pose_b) {
  return overlaps(a, pose_a.in_double(), b, pose_b.in_double());
}
template <class Other>
FloatContact contact(const Cylinder& a, const FloatPose& pose_a, const Other& b,
                     const FloatPose& pose_b, float contact_threshold,
                     const Eigen::Vector3f* previous_normal = nullptr,
                     PointRange range = PointRange::near_deepest) {
  const Vec3 previous = previous_normal ? previous_normal->cast<double>() : Vec3(Vec3::Zero());
  FloatContact result;
  round_into(contact(a, pose_a.in_double(), b, pose_b.in_double(), contact_threshold,
                     previous_normal ? &previous : nullptr, range),
             result);
  return result;
}

// As in batch.hpp: with the bits of single pairs.

void signed_distance(const Cylinder& a, std::span<const FloatPose> poses_a, const Shape& b,
                     std::span<const FloatPose> poses_b, std::span<FloatSignedDistance> results);
void overlaps(const Cylinder& a, std::span<const FloatPose> poses_a, const Shape& b,
              std::span<const FloatPose> poses_b, std::span<bool> results);
void contact(const Cylinder& a, std::span<const FloatPose> poses_a, const Shape& b,
             std::span<const FloatPose> poses_b, float contact_threshold,
             std::span<FloatContact> results, PointRange range = PointRange::near_deepest);

}  // namespace touchstone
