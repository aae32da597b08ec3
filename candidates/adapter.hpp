#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "candidates/ts_shape.hpp"

/// What adapters of engines have in common.
namespace touchstone::adapter {

/// Copies three numbers that can be indexed.
template <class Vector>
void copy(const Vector& from, double (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<double>(from[i]);
}

/// The mean of a convex body's vertices, which is inside it: where engines that search from a
/// body's origin are given that.
inline std::array<double, 3> middle_of(const ts_shape& convex) {
  std::array<double, 3> middle{};
  const auto coordinates = coordinates_of(convex);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    middle[i % 3] += coordinates[i] / convex.vertex_count;
  }
  return middle;
}

/// Begins an answer to which points are added.
inline void begin(ts_answer& answer) {
  answer.status = TS_NONE;
  answer.point_count = 0;
}

/// Adds a contact point `distance` apart, negative inside; where there is no room for it, in the
/// place of the shallowest if that is less deep. The first of the deepest gives the answer's
/// distance and normal.
template <class Position, class Normal>
void add_point(const Position& position, const Normal& normal, double distance, ts_answer& answer) {
  const bool is_full = answer.point_count == TOUCHSTONE_MAX_POINTS;
  ts_point& point = is_full ? *std::ranges::min_element(answer.points, {}, &ts_point::depth)
                            : answer.points[answer.point_count++];
  if (is_full && !(point.depth < -distance)) return;
  copy(position, point.position);
  copy(normal, point.normal);
  point.depth = -distance;
  if (answer.status == TS_CONTACT && !(distance < answer.signed_distance)) return;
  answer.status = TS_CONTACT;
  answer.signed_distance = distance;
  copy(normal, answer.normal);
}

// Functions of a ts_candidate.

inline int supports_all(void* /*context*/, ts_shape_kind /*other*/) { return 1; }
/// All but the half-space.
inline int supports_bounded(void* /*context*/, ts_shape_kind other) { return other != TS_PLANE; }
/// All but convex bodies.
inline int supports_primitives(void* /*context*/, ts_shape_kind other) {
  return other != TS_CONVEX;
}
/// The half-space alone, and the box, too.
inline int supports_plane(void* /*context*/, ts_shape_kind other) { return other == TS_PLANE; }
inline int supports_flat(void* /*context*/, ts_shape_kind other) {
  return other == TS_PLANE || other == TS_BOX;
}
template <class Prepared>
void release(Prepared* prepared) {
  delete prepared;
}

/// The plug-in of these candidates.
template <std::size_t count>
ts_plugin plugin_of(const ts_candidate (&candidates)[count],
                    decltype(ts_plugin::roundings) roundings = nullptr) {
  return {TOUCHSTONE_INTERFACE_VERSION, static_cast<int>(count), candidates, nullptr, 0, roundings};
}

}  // namespace touchstone::adapter
