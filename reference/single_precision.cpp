#include "single_precision.hpp"

#include <algorithm>
#include <limits>

#include "batch.hpp"

namespace touchstone {
namespace {

float rounded(double x) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -most, most));
}
Eigen::Vector3f rounded(const Vec3& x) { return {rounded(x.x()), rounded(x.y()), rounded(x.z())}; }
FloatSignedDistance rounded(const SignedDistance& x) {
  return {rounded(x.value), rounded(x.normal)};
}
bool rounded(bool x) { return x; }
void round_into(const Contact& from, FloatContact& to) {
  to.normal = rounded(from.normal);
  to.signed_distance = rounded(from.signed_distance);
  to.point_count = 0;
  for (const ContactPoint& p : from.points()) {
    to.all_points[static_cast<std::size_t>(to.point_count++)] = {rounded(p.position),
                                                                 rounded(p.depth)};
  }
}
template <class Answer, class FloatAnswer>
void round_into(const Answer& from, FloatAnswer& to) {
  to = rounded(from);
}

/// Calls ask(poses_a, poses_b, results) of poses in double, some after the others.
template <class Answer, class FloatAnswer, class Ask>
void ask_in_double(std::span<const FloatPose> poses_a, std::span<const FloatPose> poses_b,
                   std::span<FloatAnswer> results, Ask ask) {
  constexpr std::size_t width = 16;
  std::array<Pose, width> a, b;
  std::array<Answer, width> answers;
  check_lengths(poses_a.size(), poses_b.size(), results.size());
  for (std::size_t first = 0; first < results.size(); first += width) {
    const std::size_t count = std::min(width, results.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      a[i] = poses_a[first + i].in_double(), b[i] = poses_b[first + i].in_double();
    }
    ask(std::span(a).first(count), std::span(b).first(count), std::span(answers).first(count));
    for (std::size_t i = 0; i < count; ++i) round_into(answers[i], results[first + i]);
  }
}

}  // namespace

FloatPose::FloatPose(const Eigen::Vector3f& position, const Eigen::Quaternionf& orientation)
    : position_(position), orientation_(orientation) {
  const auto& q = orientation.coeffs();
  if (position.allFinite() && q.allFinite() && !q.isZero(0)) return;
  in_double();  // throws, and names what is wrong
}

template <class Other>
FloatSignedDistance signed_distance(const Cylinder& a, const FloatPose& pose_a, const Other& b,
                                    const FloatPose& pose_b) {
  return rounded(signed_distance(a, pose_a.in_double(), b, pose_b.in_double()));
}
template <class Other>
bool overlaps(const Cylinder& a, const FloatPose& pose_a, const Other& b, const FloatPose& pose_b) {
  return overlaps(a, pose_a.in_double(), b, pose_b.in_double());
}
template <class Other>
FloatContact contact(const Cylinder& a, const FloatPose& pose_a, const Other& b,
                     const FloatPose& pose_b, float contact_threshold,
                     const Eigen::Vector3f* previous_normal, PointRange range) {
  const Vec3 previous = previous_normal ? previous_normal->cast<double>() : Vec3(Vec3::Zero());
  FloatContact result;
  round_into(contact(a, pose_a.in_double(), b, pose_b.in_double(), contact_threshold,
                     previous_normal ? &previous : nullptr, range),
             result);
  return result;
}

template <class Other>
void signed_distance(const Cylinder& a, std::span<const FloatPose> poses_a, const Other& b,
                     std::span<const FloatPose> poses_b, std::span<FloatSignedDistance> results) {
  ask_in_double<SignedDistance>(
      poses_a, poses_b, results,
      [&](std::span<const Pose> in_a, std::span<const Pose> in_b, std::span<SignedDistance> out) {
        signed_distance(a, in_a, b, in_b, out);
      });
}
template <class Other>
void overlaps(const Cylinder& a, std::span<const FloatPose> poses_a, const Other& b,
              std::span<const FloatPose> poses_b, std::span<bool> results) {
  ask_in_double<bool>(poses_a, poses_b, results,
                      [&](std::span<const Pose> in_a, std::span<const Pose> in_b,
                          std::span<bool> out) { overlaps(a, in_a, b, in_b, out); });
}
template <class Other>
void contact(const Cylinder& a, std::span<const FloatPose> poses_a, const Other& b,
             std::span<const FloatPose> poses_b, float contact_threshold,
             std::span<FloatContact> results, PointRange range) {
  ask_in_double<Contact>(
      poses_a, poses_b, results,
      [&](std::span<const Pose> in_a, std::span<const Pose> in_b, std::span<Contact> out) {
        contact(a, in_a, b, in_b, contact_threshold, out, range);
      });
}

#define TOUCHSTONE_INSTANTIATE(Other)                                                              \
  template FloatSignedDistance signed_distance(const Cylinder&, const FloatPose&, const Other&,    \
                                               const FloatPose&);                                  \
  template bool overlaps(const Cylinder&, const FloatPose&, const Other&, const FloatPose&);       \
  template FloatContact contact(const Cylinder&, const FloatPose&, const Other&, const FloatPose&, \
                                float, const Eigen::Vector3f*, PointRange);                        \
  template void signed_distance(const Cylinder&, std::span<const FloatPose>, const Other&,         \
                                std::span<const FloatPose>, std::span<FloatSignedDistance>);       \
  template void overlaps(const Cylinder&, std::span<const FloatPose>, const Other&,                \
                         std::span<const FloatPose>, std::span<bool>);                             \
  template void contact(const Cylinder&, std::span<const FloatPose>, const Other&,                 \
                        std::span<const FloatPose>, float, std::span<FloatContact>, PointRange)
TOUCHSTONE_INSTANTIATE(Plane);
TOUCHSTONE_INSTANTIATE(Sphere);
TOUCHSTONE_INSTANTIATE(Capsule);
TOUCHSTONE_INSTANTIATE(Cylinder);
TOUCHSTONE_INSTANTIATE(Box);
#undef TOUCHSTONE_INSTANTIATE

}  // namespace touchstone
