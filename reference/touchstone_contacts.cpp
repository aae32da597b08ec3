#include "touchstone_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "batch.hpp"
#include "cast.hpp"
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

/// Of a body or a pose.
template <class Posed>
Pose to_pose(const Posed& posed) {
  const double* q = posed.orientation;
  return Pose(Vec3(posed.position), Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}
FloatPose to_pose(const touchstone_float_pose& pose) {
  const float* q = pose.orientation;
  return FloatPose(Eigen::Vector3f(pose.position), Eigen::Quaternionf(q[0], q[1], q[2], q[3]));
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

void copy_cast(const touchstone::Cast& from, touchstone_cast& to) {
  constexpr touchstone_cast_status statuses[] = {TOUCHSTONE_CAST_TOUCH, TOUCHSTONE_CAST_NEVER,
                                                 TOUCHSTONE_CAST_FROM_START};
  to.status = statuses[static_cast<int>(from.status)];
  to.fraction = from.fraction;
  copy(from.normal, to.normal);
}

/// Calls ask(a, poses_a, b, poses_b, results) of some poses after the others, copies the answers
/// and returns 0; or 1, before it calls, if a body or pose is invalid.
template <class Answer, class PoseInC, class AnswerInC, class Ask, class Copy>
int ask_batch(const touchstone_body* a, const PoseInC* poses_a, const touchstone_body* b,
              const PoseInC* poses_b, std::size_t count, AnswerInC* answers, Ask ask,
              Copy copy_answer) try {
  constexpr std::size_t width = 16;
  using OnePose = decltype(to_pose(*poses_a));
  if (a->kind != TOUCHSTONE_CYLINDER) return 1;
  const Cylinder cylinder(a->size[0], a->size[1]);
  const touchstone::Shape other = to_shape(*b);
  for (std::size_t i = 0; i < count; ++i) to_pose(poses_a[i]), to_pose(poses_b[i]);
  std::array<OnePose, width> in_a, in_b;
  std::array<Answer, width> results;
  for (std::size_t first = 0; first < count; first += width) {
    const std::size_t some = std::min(width, count - first);
    for (std::size_t i = 0; i < some; ++i) {
      in_a[i] = to_pose(poses_a[first + i]), in_b[i] = to_pose(poses_b[first + i]);
    }
    const std::span<const OnePose> of_a(in_a.data(), some), of_b(in_b.data(), some);
    ask(cylinder, of_a, other, of_b, std::span(results).first(some));
    for (std::size_t i = 0; i < some; ++i) copy_answer(results[i], answers[first + i]);
  }
  return 0;
} catch (const touchstone::InvalidInput&) {
  return 1;
}

template <class Contact, class PoseInC, class Threshold, class ContactInC>
int find_contacts(const touchstone_body* a, const PoseInC* poses_a, const touchstone_body* b,
                  const PoseInC* poses_b, std::size_t count, Threshold threshold,
                  ContactInC* contacts) {
  return ask_batch<Contact>(
      a, poses_a, b, poses_b, count, contacts,
      [&](const auto& shape_a, auto of_a, const auto& shape_b, auto of_b, auto results) {
        contact(shape_a, of_a, shape_b, of_b, threshold, results);
      },
      copy_contact<Contact, ContactInC>);
}

template <class Distance, class PoseInC, class DistanceInC>
int find_signed_distances(const touchstone_body* a, const PoseInC* poses_a,
                          const touchstone_body* b, const PoseInC* poses_b, std::size_t count,
                          DistanceInC* distances) {
  return ask_batch<Distance>(
      a, poses_a, b, poses_b, count, distances,
      [](const auto&... asked) { signed_distance(asked...); },
      copy_distance<Distance, DistanceInC>);
}

template <class PoseInC>
int find_overlaps(const touchstone_body* a, const PoseInC* poses_a, const touchstone_body* b,
                  const PoseInC* poses_b, std::size_t count, int* overlap) {
  return ask_batch<bool>(
      a, poses_a, b, poses_b, count, overlap, [](const auto&... asked) { overlaps(asked...); },
      [](bool from, int& to) { to = from ? 1 : 0; });
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

int touchstone_find_cast(const touchstone_body* a, const double sweep[3], const touchstone_body* b,
                         touchstone_cast* result) {
  return ask(a, b,
             [&](const Configuration& c) { copy_cast(touchstone::cast(c, Vec3(sweep)), *result); });
}

int touchstone_find_casts(const touchstone_body* a, const touchstone_pose* poses_a,
                          const double* sweeps, const touchstone_body* b,
                          const touchstone_pose* poses_b, size_t count, touchstone_cast* casts) {
  const bool are_finite =
      std::all_of(sweeps, sweeps + 3 * count, [](double x) { return std::isfinite(x); });
  if (!are_finite) return 1;
  std::size_t next = 0;
  return ask_batch<touchstone::Cast>(
      a, poses_a, b, poses_b, count, casts,
      [&](const auto& shape_a, auto of_a, const auto& shape_b, auto of_b, auto results) {
        for (std::size_t i = 0; i < results.size(); ++i, ++next) {
          results[i] = cast(shape_a, of_a[i], Vec3(sweeps + 3 * next), shape_b, of_b[i]);
        }
      },
      copy_cast);
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
