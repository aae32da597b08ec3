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

  /// For a segment, half of it as a vector; zero for everything else.
  Vec3 half_segment() const {
    const bool is_segment = disc_radius_ == 0 && (free_.array() != 0).count() == 1;
    return is_segment ? Vec3(rotation_ * free_) : Vec3(Vec3::Zero());
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

/// Nearest points of two segments that are not parallel. Ericson, "Real-Time Collision
/// Detection", 5.1.9, with both parameters in [−1, 1].
Witness nearest_on_segments(const Vec3& middle_a, const Vec3& half_a, const Vec3& middle_b,
                            const Vec3& half_b) {
  const Vec3 apart = middle_a - middle_b;
  const double aa = half_a.squaredNorm(), bb = half_b.squaredNorm(), ab = half_a.dot(half_b);
  const double a = half_a.dot(apart), b = half_b.dot(apart);
  const double determinant = half_a.cross(half_b).squaredNorm();
  double s = std::clamp((ab * b - bb * a) / determinant, -1.0, 1.0);
  const double t = std::clamp((ab * s + b) / bb, -1.0, 1.0);
  s = std::clamp((ab * t - a) / aa, -1.0, 1.0);
  return {middle_a + s * half_a, middle_b + t * half_b};
}

/// The point of a body nearest to x; x itself inside.
struct NearestInBody {
  const Pose& pose;
  Vec3 x;
  Vec3 operator()(const Cylinder& s) const {
    return from_local([&](Vec3 local) {
      const double reach = std::hypot(local.x(), local.y());
      if (reach > s.radius()) local.head<2>() *= s.radius() / reach;
      local.z() = std::clamp(local.z(), -s.half_length(), s.half_length());
      return local;
    });
  }
  Vec3 operator()(const Capsule& s) const {
    return from_local([&](const Vec3& local) {
      const Vec3 on_segment(0, 0, std::clamp(local.z(), -s.half_length(), s.half_length()));
      const double reach = (local - on_segment).norm();
      return reach > s.radius() ? Vec3(on_segment + s.radius() / reach * (local - on_segment))
                                : local;
    });
  }
  Vec3 operator()(const Box& s) const {
    return from_local([&](const Vec3& local) {
      return Vec3(local.cwiseMax(-s.half_extents()).cwiseMin(s.half_extents()));
    });
  }
  Vec3 operator()(const Sphere&) const { return x; }
  Vec3 operator()(const Plane&) const { return x; }

 private:
  template <class Clamp>
  Vec3 from_local(Clamp clamp) const {
    const Eigen::Matrix3d rotation = pose.rotation();
    return pose.position() + rotation * clamp(rotation.transpose() * (x - pose.position()));
  }
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
                const Vec3& normal, double signed_distance) {
  const Feature feature_a(a.radius(), a.half_length(), pose_a, -normal);
  const Feature feature_b = std::visit(FeatureOfB{pose_b, normal}, b);
  const Vec3 half_a = feature_a.half_segment(), half_b = feature_b.half_segment();
  Witness w{feature_a.nearest(feature_b.middle()), feature_b.middle()};
  if (half_a.cross(half_b).squaredNorm() > 1e-24 * half_a.squaredNorm() * half_b.squaredNorm()) {
    w = nearest_on_segments(feature_a.middle(), half_a, feature_b.middle(), half_b);
  } else {
    // Flat features across the normal, parallel segments or points: alternating projections onto
    // two convex sets meet where these overlap.
    constexpr int projections = 20;
    for (int i = 0; i < projections; ++i) {
      const Vec3 on_b = feature_b.nearest(w.on_a);
      const Vec3 on_a = feature_a.nearest(on_b);
      if (on_b == w.on_b && on_a == w.on_a) break;
      w = {on_a, on_b};
    }
  }
  if (const auto* capsule = std::get_if<Capsule>(&b)) w.on_b += capsule->radius() * normal;

  // Nearly flat features leave the two a little aside of each other. A and B moved by the signed
  // distance touch, so a point of both is near: projections onto the bodies themselves find it.
  const Vec3 shift = signed_distance * normal;
  constexpr int polish = 100;
  for (int i = 0; i < polish && !(w.on_a - w.on_b).isApprox(shift, 1e-14); ++i) {
    w.on_b = std::visit(NearestInBody{pose_b, w.on_a - shift}, b);
    w.on_a = NearestInBody{pose_a, w.on_b + shift}(a);
  }
  return w;
}

}  // namespace touchstone
