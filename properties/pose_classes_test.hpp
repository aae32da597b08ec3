#pragma once

#include <array>
#include <cstdint>
#include <gmpxx.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "properties/pose_class.hpp"

namespace touchstone {

// Samples of pose classes for the tests of what these promise, and relations of their bodies in
// rational arithmetic.

constexpr std::uint64_t samples = 40;

inline bool has_class(Pair pair, const std::string& name) {
  return !selected_classes(pair, {.names = {name}}).empty();
}

/// Calls expect(configuration, pair) of `count` samples of each of these classes that a pair has;
/// one of them must have some.
template <class Expect>
void expect_of_each(const std::vector<Pair>& pairs, const std::vector<std::string>& classes,
                    Expect expect, std::uint64_t count = samples) {
  bool any = false;
  for (const Pair pair : pairs) {
    for (const std::string& name : classes) {
      if (!has_class(pair, name)) continue;
      any = true;
      for (std::uint64_t i = 0; i < count; ++i) {
        const Identity id{pair, name, 1, i};
        SCOPED_TRACE(to_string(id));
        expect(make_configuration(id), pair);
      }
    }
  }
  EXPECT_TRUE(any) << "no pair has such a class";
}
inline const std::vector<Pair> every_pair(std::begin(all_pairs), std::end(all_pairs));
/// Those whose body B has an axis, a hull where it lies exactly aligned.
inline const std::vector<Pair> pairs_of_axes = {Pair::capsule, Pair::cylinder, Pair::box,
                                                Pair::convex};

using ExactVector = std::array<mpq_class, 3>;

/// Local axis number i of a pose times |q|², exactly.
inline ExactVector exact_column(const Pose& pose, int i) {
  const auto& q = pose.orientation();
  const mpq_class w(q.w()), x(q.x()), y(q.y()), z(q.z());
  if (i == 0) return {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
  if (i == 1) return {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
  return {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
}
inline mpq_class dot(const ExactVector& a, const ExactVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline ExactVector cross(const ExactVector& a, const ExactVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline bool exactly_parallel(const Configuration& c) {
  return cross(exact_column(c.pose_a, 2), exact_column(c.pose_b, 2)) == ExactVector{0, 0, 0};
}
inline bool exactly_perpendicular(const Configuration& c) {
  return dot(exact_column(c.pose_a, 2), exact_column(c.pose_b, 2)) == 0;
}

/// Sine and cosine of the angle between the axes, each without cancellation.
struct AxisAngle {
  double sine, cosine;
};
inline AxisAngle axis_angle(const Configuration& c) {
  const ExactVector a = exact_column(c.pose_a, 2), b = exact_column(c.pose_b, 2), n = cross(a, b);
  const mpq_class lengths = dot(a, a) * dot(b, b), cosine = dot(a, b);
  const mpq_class sine_squared = dot(n, n) / lengths, cosine_squared = cosine * cosine / lengths;
  return {std::sqrt(sine_squared.get_d()), std::sqrt(cosine_squared.get_d())};
}

/// Where A's centre lies from B's, along local axis number i of one of the poses, exactly.
inline mpq_class offset_along(const Configuration& c, const Pose& pose, int i) {
  const ExactVector e = exact_column(pose, i);
  ExactVector offset;
  for (int k = 0; k < 3; ++k) {
    offset[k] = mpq_class(c.pose_a.position()[k]) - mpq_class(c.pose_b.position()[k]);
  }
  const auto& q = pose.orientation();
  const mpq_class w(q.w()), x(q.x()), y(q.y()), z(q.z());
  return dot(e, offset) / (w * w + x * x + y * y + z * z);
}

/// B's half extents along its local axes; a capsule's without its round ends.
inline Vec3 half_extents_of_b(const Configuration& c) {
  if (const auto* s = std::get_if<Box>(&c.b)) return s->half_extents();
  if (const auto* s = std::get_if<Convex>(&c.b)) return s->half_extents();
  if (const auto* s = std::get_if<Capsule>(&c.b)) {
    return {s->radius(), s->radius(), s->half_length()};
  }
  const auto& s = std::get<Cylinder>(c.b);
  return {s.radius(), s.radius(), s.half_length()};
}

}  // namespace touchstone
