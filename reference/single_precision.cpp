#include "single_precision.hpp"

#include <algorithm>

#include "batch.hpp"

namespace touchstone {
namespace {

void round_into(bool from, bool& to) { to = from; }

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

void round_into(const Contact& from, FloatContact& to) {
  to.normal = rounded(from.normal);
  to.signed_distance = rounded(from.signed_distance);
  to.point_count = 0;
  for (const ContactPoint& p : from.points()) {
    to.all_points[static_cast<std::size_t>(to.point_count++)] = {rounded(p.position),
                                                                 rounded(p.depth)};
  }
}

void signed_distance(const Cylinder& a, std::span<const FloatPose> poses_a, const Shape& b,
                     std::span<const FloatPose> poses_b, std::span<FloatSignedDistance> results) {
  ask_in_double<SignedDistance>(poses_a, poses_b, results, [&](auto in_a, auto in_b, auto answers) {
    signed_distance(a, in_a, b, in_b, answers);
  });
}
void overlaps(const Cylinder& a, std::span<const FloatPose> poses_a, const Shape& b,
              std::span<const FloatPose> poses_b, std::span<bool> results) {
  ask_in_double<bool>(poses_a, poses_b, results, [&](auto in_a, auto in_b, auto answers) {
    overlaps(a, in_a, b, in_b, answers);
  });
}
void contact(const Cylinder& a, std::span<const FloatPose> poses_a, const Shape& b,
             std::span<const FloatPose> poses_b, float contact_threshold,
             std::span<FloatContact> results, PointRange range) {
  ask_in_double<Contact>(poses_a, poses_b, results, [&](auto in_a, auto in_b, auto answers) {
    contact(a, in_a, b, in_b, contact_threshold, answers, range);
  });
}

}  // namespace touchstone
