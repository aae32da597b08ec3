#include "touchstone_contacts.h"

#include <algorithm>
#include <array>
#include <string>

#include "batch.hpp"
#include "contact_of.hpp"
#include "invalid_input.hpp"
#include "single_precision.hpp"

namespace {

using touchstone::Configuration;
using touchstone::Cylinder;
using touchstone::FloatPose;
using touchstone::Pose;
using touchstone::Vec3;

touchstone::Shape to_shape(const touchstone_body& body) {
  const double* s = body.size;
  switch (body.kind) {
    case TOUCHSTONE_CYLINDER:
      return Cylinder(s[0], s[1]);
    case TOUCHSTONE_PLANE:
      return touchstone::Plane(Vec3(s[0], s[1], s[2]), s[3]);
    case TOUCHSTONE_SPHERE:
      return touchstone::Sphere(s[0]);
    case TOUCHSTONE_CAPSULE:
      return touchstone::Capsule(s[0], s[1]);
    case TOUCHSTONE_BOX:
      return touchstone::Box(Vec3(s[0], s[1], s[2]));
  }
  throw touchstone::InvalidInput("kind", std::to_string(body.kind),
                                 "must be one of the five shapes");
}

Pose to_pose(const touchstone_body& body) {
  const double* q = body.orientation;
  return Pose(Vec3(body.position), Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}

/// Calls with the bodies' configuration and returns 0; or 1 if there is none.
template <class Question>
int ask(const touchstone_body* a, const touchstone_body* b, Question question) try {
  if (a->kind != TOUCHSTONE_CYLINDER) return 1;
  question(Configuration{Cylinder(a->size[0], a->size[1]), to_pose(*a), to_shape(*b), to_pose(*b)});
  return 0;
} catch (const touchstone::InvalidInput&) {
  return 1;
}

void copy(const Vec3& from, double (&to)[3]) { std::copy_n(from.data(), 3, to); }
void copy(const Eigen::Vector3f& from, float (&to)[3]) { std::copy_n(from.data(), 3, to); }

/// Of contacts in double or float.
template <class Contact, class ContactInC>
void copy_contact(const Contact& from, ContactInC& to) {
  copy(from.normal, to.normal);
  to.signed_distance = from.signed_distance;
  to.point_count = 0;
  for (const auto& p : from.points()) {
    auto& point = to.points[to.point_count++];
    copy(p.position, point.position);
    point.depth = p.depth;
  }
}
template <class Distance, class DistanceInC>
void copy_distance(const Distance& from, DistanceInC& to) {
  to.value = from.value;
  copy(from.normal, to.normal);
}

Pose to_pose(const touchstone_pose& pose) {
  const double* q = pose.orientation;
  return Pose(Vec3(pose.position), Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}
FloatPose to_pose(const touchstone_float_pose& pose) {
  const float* q = pose.orientation;
  return FloatPose(Eigen::Vector3f(pose.position), Eigen::Quaternionf(q[0], q[1], q[2], q[3]));
}

/// Calls question(a, poses_a, b, poses_b, first) of some poses after the others and returns 0; or
/// 1, before it calls, if a body or pose is invalid.
template <class PoseInC, class Question>
int ask_batch(const touchstone_body* a, const PoseInC* poses_a, const touchstone_body* b,
              const PoseInC* poses_b, std::size_t count, Question question) try {
  constexpr std::size_t width = 16;
  using OnePose = decltype(to_pose(*poses_a));
  if (a->kind != TOUCHSTONE_CYLINDER) return 1;
  const Cylinder cylinder(a->size[0], a->size[1]);
  const touchstone::Shape other = to_shape(*b);
  for (std::size_t i = 0; i < count; ++i) to_pose(poses_a[i]), to_pose(poses_b[i]);
  std::array<OnePose, width> in_a, in_b;
  for (std::size_t first = 0; first < count; first += width) {
    const std::size_t some = std::min(width, count - first);
    for (std::size_t i = 0; i < some; ++i) {
      in_a[i] = to_pose(poses_a[first + i]), in_b[i] = to_pose(poses_b[first + i]);
    }
    const std::span<const OnePose> of_a(in_a.data(), some), of_b(in_b.data(), some);
    std::visit([&](const auto& shape) { question(cylinder, of_a, shape, of_b, first); }, other);
  }
  return 0;
} catch (const touchstone::InvalidInput&) {
  return 1;
}

/// Calls ask(results) with room for some answers, and copies them.
template <class Answer, class AnswerInC, class Ask, class Copy>
void answer_some(std::size_t count, AnswerInC* answers, Ask ask, Copy copy_answer) {
  std::array<Answer, 16> results;
  ask(std::span(results).first(count));
  for (std::size_t i = 0; i < count; ++i) copy_answer(results[i], answers[i]);
}

template <class Contact, class PoseInC, class Threshold, class ContactInC>
int find_contacts(const touchstone_body* a, const PoseInC* poses_a, const touchstone_body* b,
                  const PoseInC* poses_b, std::size_t count, Threshold threshold,
                  ContactInC* contacts) {
  return ask_batch(
      a, poses_a, b, poses_b, count,
      [&](const auto& shape_a, auto of_a, const auto& shape_b, auto of_b, std::size_t first) {
        answer_some<Contact>(
            of_a.size(), contacts + first,
            [&](auto results) { contact(shape_a, of_a, shape_b, of_b, threshold, results); },
            [](const Contact& from, ContactInC& to) { copy_contact(from, to); });
      });
}

template <class Distance, class PoseInC, class DistanceInC>
int find_signed_distances(const touchstone_body* a, const PoseInC* poses_a,
                          const touchstone_body* b, const PoseInC* poses_b, std::size_t count,
                          DistanceInC* distances) {
  return ask_batch(
      a, poses_a, b, poses_b, count,
      [&](const auto& shape_a, auto of_a, const auto& shape_b, auto of_b, std::size_t first) {
        answer_some<Distance>(
            of_a.size(), distances + first,
            [&](auto results) { signed_distance(shape_a, of_a, shape_b, of_b, results); },
            [](const Distance& from, DistanceInC& to) { copy_distance(from, to); });
      });
}

template <class PoseInC>
int find_overlaps(const touchstone_body* a, const PoseInC* poses_a, const touchstone_body* b,
                  const PoseInC* poses_b, std::size_t count, int* overlap) {
  return ask_batch(
      a, poses_a, b, poses_b, count,
      [&](const auto& shape_a, auto of_a, const auto& shape_b, auto of_b, std::size_t first) {
        answer_some<bool>(
            of_a.size(), overlap + first,
            [&](auto results) { overlaps(shape_a, of_a, shape_b, of_b, results); },
            [](bool from, int& to) { to = from ? 1 : 0; });
      });
}

}  // namespace

int touchstone_find_contact(const touchstone_body* a, const touchstone_body* b, double threshold,
                            touchstone_contact* contact) {
  return ask(a, b, [&](const Configuration& c) {
    copy_contact(touchstone::contact(c, threshold), *contact);
  });
}

int touchstone_find_signed_distance(const touchstone_body* a, const touchstone_body* b,
                                    double* signed_distance, double normal[3]) {
  return ask(a, b, [&](const Configuration& c) {
    const touchstone::SignedDistance found = touchstone::signed_distance(c);
    *signed_distance = found.value;
    std::copy_n(found.normal.data(), 3, normal);
  });
}

int touchstone_find_overlap(const touchstone_body* a, const touchstone_body* b, int* overlap) {
  return ask(a, b, [&](const Configuration& c) { *overlap = touchstone::overlaps(c) ? 1 : 0; });
}

int touchstone_find_contacts(const touchstone_body* a, const touchstone_pose* poses_a,
                             const touchstone_body* b, const touchstone_pose* poses_b, size_t count,
                             double threshold, touchstone_contact* contacts) {
  return find_contacts<touchstone::Contact>(a, poses_a, b, poses_b, count, threshold, contacts);
}

int touchstone_find_signed_distances(const touchstone_body* a, const touchstone_pose* poses_a,
                                     const touchstone_body* b, const touchstone_pose* poses_b,
                                     size_t count, touchstone_distance* distances) {
  return find_signed_distances<touchstone::SignedDistance>(a, poses_a, b, poses_b, count,
                                                           distances);
}

int touchstone_find_overlaps(const touchstone_body* a, const touchstone_pose* poses_a,
                             const touchstone_body* b, const touchstone_pose* poses_b, size_t count,
                             int* overlaps) {
  return find_overlaps(a, poses_a, b, poses_b, count, overlaps);
}

int touchstone_find_float_contacts(const touchstone_body* a, const touchstone_float_pose* poses_a,
                                   const touchstone_body* b, const touchstone_float_pose* poses_b,
                                   size_t count, float threshold,
                                   touchstone_float_contact* contacts) {
  return find_contacts<touchstone::FloatContact>(a, poses_a, b, poses_b, count, threshold,
                                                 contacts);
}

int touchstone_find_float_signed_distances(const touchstone_body* a,
                                           const touchstone_float_pose* poses_a,
                                           const touchstone_body* b,
                                           const touchstone_float_pose* poses_b, size_t count,
                                           touchstone_float_distance* distances) {
  return find_signed_distances<touchstone::FloatSignedDistance>(a, poses_a, b, poses_b, count,
                                                                distances);
}

int touchstone_find_float_overlaps(const touchstone_body* a, const touchstone_float_pose* poses_a,
                                   const touchstone_body* b, const touchstone_float_pose* poses_b,
                                   size_t count, int* overlaps) {
  return find_overlaps(a, poses_a, b, poses_b, count, overlaps);
}
