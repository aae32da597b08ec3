#include "witness.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

/// A direction counts as across an axis, or along it, when its sine or cosine is below this: the
/// points of the feature then differ in depth by less than this times the size.
constexpr double flat = 1e-9;

/// The points of a body where it supports a direction: a vertex, segment, disc or rectangle.
class Feature {
 public:
  /// Of a cylinder, or with radius zero of a segment.
  Feature(double radius, double half_length, const Pose& pose, const Vec3& direction)
      : rotation_(pose.rotation()), centre_(pose.position()) {
    const Vec3 n = rotation_.transpose() * direction;
    const double across = std::hypot(n.x(), n.y());
    local_.setZero();
    if (std::abs(n.z()) <= flat) {
      free_.z() = half_length;
    } else {
      local_.z() = std::copysign(half_length, n.z());
    }
    if (across <= flat) {
      disc_radius_ = radius;
    } else {
      local_.x() = radius * n.x() / across;
      local_.y() = radius * n.y() / across;
    }
  }

  Feature(const Box& box, const Pose& pose, const Vec3& direction)
      : rotation_(pose.rotation()), centre_(pose.position()) {
    const Vec3 n = rotation_.transpose() * direction;
    for (int i = 0; i < 3; ++i) {
      const double h = box.half_extents()[i];
      const bool spans = std::abs(n[i]) <= flat;
      local_[i] = spans ? 0 : std::copysign(h, n[i]);
      free_[i] = spans ? h : 0;
    }
  }

  Vec3 middle() const { return centre_ + rotation_ * local_; }

  /// The feature's point nearest to x.
  Vec3 nearest(const Vec3& x) const {
    Vec3 offset = rotation_.transpose() * (x - centre_) - local_;
    const double reach = std::hypot(offset.x(), offset.y());
    const double keep = reach > disc_radius_ ? disc_radius_ / reach : 1;
    const bool disc = disc_radius_ > 0;
    for (int i = 0; i < 3; ++i) {
      offset[i] = disc && i < 2 ? offset[i] * keep : std::clamp(offset[i], -free_[i], free_[i]);
    }
    return centre_ + rotation_ * (local_ + offset);
  }

 private:
  Eigen::Matrix3d rotation_;
  Vec3 centre_;
  Vec3 local_;                // in the body frame: the middle of the feature
  Vec3 free_ = Vec3::Zero();  // half lengths along which the feature extends
  double disc_radius_ = 0;    // of a cap
};

struct FeatureOfB {
  const Pose& pose;
  const Vec3& n;
  Feature operator()(const Capsule& s) const { return {0, s.half_length(), pose, n}; }
  Feature operator()(const Cylinder& s) const { return {s.radius(), s.half_length(), pose, n}; }
  Feature operator()(const Box& s) const { return {s, pose, n}; }
  Feature operator()(const Sphere&) const { return {0, 0, pose, n}; }
  Feature operator()(const Plane&) const { return {0, 0, pose, n}; }
};

}  // namespace

Witness witness(const Cylinder& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                const Vec3& normal) {
  const Feature feature_a(a.radius(), a.half_length(), pose_a, -normal);
  const Feature feature_b = std::visit(FeatureOfB{pose_b, normal}, b);
  // Both features lie across the normal (flat ones) or are points, so that alternating projections
  // onto the two convex sets meet where they overlap.
  constexpr int projections = 20;
  Witness w{feature_a.nearest(feature_b.middle()), feature_b.middle()};
  for (int i = 0; i < projections; ++i) {
    const Vec3 on_b = feature_b.nearest(w.on_a);
    const Vec3 on_a = feature_a.nearest(on_b);
    if (on_b == w.on_b && on_a == w.on_a) break;
    w = {on_a, on_b};
  }
  if (const auto* capsule = std::get_if<Capsule>(&b)) w.on_b += capsule->radius() * normal;
  return w;
}

}  // namespace touchstone
