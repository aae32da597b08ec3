#include "cylinder_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "disc_layout.hpp"
#include "facing_feature.hpp"
#include "largest_gap.hpp"
#include "margins.hpp"
#include "scaled.hpp"

namespace touchstone {
namespace {

/// The plane in the world, and how the cylinder stands to it.
struct Stance {
  Vec3 normal;           ///< the plane's, unit
  double centre_height;  ///< of the cylinder's centre above the plane
  double x, y, cosine;   ///< the normal in the cylinder's frame
  double sine;           ///< not from the cosine, which hides a small tilt
  double signed_distance;

  Stance(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b) {
    normal = pose_b.rotation() * b.unit_normal();
    const Eigen::Matrix3d& axes = pose_a.rotation();
    x = axes.col(0).dot(normal);
    y = axes.col(1).dot(normal);
    cosine = axes.col(2).dot(normal);
    sine = std::sqrt(x * x + y * y);
    centre_height = normal.dot(pose_a.position() - pose_b.position()) - b.unit_displacement();
    // The deepest point is on the lower cap's rim.
    signed_distance = centre_height - a.half_length() * std::abs(cosine) - a.radius() * sine;
  }
};

/// Adds points of the cylinder's surface, each halfway to the plane below it.
class Points {
 public:
  Points(Contact& contact, const Stance& stance, const Pose& pose_a)
      : contact_(contact), stance_(stance), pose_(pose_a) {}

  /// The point (x, y, z) of the cylinder's frame.
  void add(double x, double y, double z) {
    add(x, y, z, stance_.centre_height + x * stance_.x + y * stance_.y + z * stance_.cosine);
  }
  void add(double x, double y, double z, double height) {
    const Eigen::Matrix3d& axes = pose_.rotation();
    const Vec3 arm = x * axes.col(0) + y * axes.col(1) + z * axes.col(2);
    contact_.add_point(pose_.position() + (arm - height / 2 * stance_.normal), -height);
  }

 private:
  Contact& contact_;
  const Stance& stance_;
  const Pose& pose_;
};

/// Points of the lower cap (disc_layout.hpp), the first where the cylinder's own x axis meets its
/// rim: the plane looks alike all around.
void add_cap(Points& points, const Cylinder& a, const Stance& s, const Margins& margins) {
  const double z = -std::copysign(a.half_length(), s.cosine), r = a.radius();
  std::array<Vec2, 6> arms;
  const int count =
      spread_disc(r, Vec2(s.x, s.y), Vec2(1, 0), margins.slack, margins.clear_rise, arms);
  for (int i = 0; i < count; ++i) points.add(arms[i].x(), arms[i].y(), z);
}

/// The lowest generator's ends in the order of its axis, or instead of the higher one where the
/// generator rises above the slack.
void add_generator(Points& points, const Cylinder& a, const Stance& s, double slack) {
  const double scale = -a.radius() / s.sine, x = scale * s.x, y = scale * s.y;
  const double low = -std::copysign(a.half_length(), s.cosine);
  const double rise = 2 * a.half_length() * std::abs(s.cosine);
  const double high = rise > slack ? low * (1 - 2 * slack / rise) : -low;
  points.add(x, y, low < 0 ? low : high);
  points.add(x, y, low < 0 ? high : low);
}

Contact contact_in_range(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                         double contact_threshold) {
  const Stance stance(a, pose_a, b, pose_b);
  Contact result;
  result.normal = stance.normal;
  result.signed_distance = stance.signed_distance;
  if (stance.signed_distance > contact_threshold) return result;

  const Extents extents{std::min(a.radius(), a.half_length()), largest_half_extent(a)};
  const Margins margins(extents, extents, std::abs(stance.centre_height), stance.signed_distance,
                        contact_threshold);
  const double slack = margins.slack;
  Points points(result, stance, pose_a);
  if (lies_flat(a.radius(), stance.sine, slack)) {
    add_cap(points, a, stance, margins);
  } else if (lies_flat(a.half_length(), stance.cosine, slack)) {
    add_generator(points, a, stance, slack);
  } else {
    const double scale = -a.radius() / stance.sine;
    points.add(scale * stance.x, scale * stance.y, -std::copysign(a.half_length(), stance.cosine),
               stance.signed_distance);
  }
  return result;
}

}  // namespace

SignedDistance signed_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                               const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return signed_distance(bodies...); }));
  }
  const Stance stance(a, pose_a, b, pose_b);
  return {stance.signed_distance, stance.normal};
}

CertifiedDistance certified_distance(const Cylinder& a, const Pose& pose_a, const Plane& b,
                                     const Pose& pose_b) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(
        scaled.ask([](const auto&... bodies) { return certified_distance(bodies...); }));
  }
  const Stance stance(a, pose_a, b, pose_b);
  const double lengths = std::abs(b.unit_displacement()) +
                         (pose_a.position() - pose_b.position()).cwiseAbs().sum() + a.radius() +
                         a.half_length();
  return {{stance.signed_distance, stance.normal}, rounding_part * lengths};
}

bool overlaps(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b) {
  return signed_distance(a, pose_a, b, pose_b).value <= 0;
}

Contact contact(const Cylinder& a, const Pose& pose_a, const Plane& b, const Pose& pose_b,
                double contact_threshold, const Vec3*) {
  if (!ordinary(a, pose_a, b, pose_b)) {
    const ScaledBodies scaled(a, pose_a, b, pose_b);
    return scaled.back(scaled.ask([&](const auto&... bodies) {
      return contact(bodies..., scaled.scaled(contact_threshold));
    }));
  }
  return contact_in_range(a, pose_a, b, pose_b, contact_threshold);
}

}  // namespace touchstone
