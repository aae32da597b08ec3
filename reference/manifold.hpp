#pragma once

#include <algorithm>
#include <limits>

#include "contact.hpp"
#include "posed_body.hpp"

namespace touchstone {

/// A body's smallest and largest half extent.
struct Extents {
  double smallest, largest;
};
inline Extents extents(const PosedCylinder& s) {
  return {std::min(s.radius, s.half_length), std::max(s.radius, s.half_length)};
}
inline Extents extents(const PosedCapsule& s) { return {s.radius, s.half_length + s.radius}; }
inline Extents extents(const PosedBox& s) {
  return {s.half_extents.minCoeff(), s.half_extents.maxCoeff()};
}
inline Extents extents(const PosedConvex& s) {
  return {s.body.smallest_half_extent(), largest_half_extent(s.body)};
}

/// Lengths that decide on the points of a contact, metres.
struct Margins {
  /// How far above the deepest point a surface may lie and still carry a point: a thousandth of the
  /// smaller body's largest half extent, so that a standing or lying body keeps its points when a
  /// step of a simulation tilts it, as long as they overlap (or as far as the range asks): no more
  /// than the contact threshold leaves above the deepest point; never less than rounding.
  double slack;
  /// A feature that leans by no more counts as facing the other body, even where the threshold
  /// leaves less room: so little decides which of a cap's or generator's points is the deepest, and
  /// not always one that the other body reaches.
  double flat;
  double rounding;  ///< of what is known of the bodies' surfaces
  double smallest;  ///< half extent of both bodies
  bool is_near;     ///< only points near the deepest one are asked for

  /// `offset` is how far the bodies' centres are apart, or somewhat more.
  Margins(const Extents& a, const Extents& b, double offset, double signed_distance,
          double contact_threshold, PointRange range = PointRange::near_deepest) {
    constexpr double hair = 1e-3, invisible = 1e-4,
                     epsilon = std::numeric_limits<double>::epsilon();
    rounding = 16 * epsilon * (std::max(a.largest, b.largest) + offset);
    const double smaller = std::min(a.largest, b.largest);
    const double room = contact_threshold - signed_distance;
    is_near = range == PointRange::near_deepest;
    slack = std::max(rounding, is_near ? std::min(hair * smaller, room) : room);
    flat = std::max(slack, invisible * smaller);
    smallest = std::min(a.smallest, b.smallest);
  }
  /// How much higher one side of a patch than the other is seen, and not taken for the rounding of
  /// a body at rest: a millionth of the smallest half extent, the contact threshold that engines
  /// use.
  double clear_rise() const {
    constexpr double clear = 1e-6;
    return std::min(std::max(clear * smallest, rounding), slack / 8);
  }
  /// The deepest point of a layout that does not see which way the bodies lean lacks less than this
  /// of their depth (disc_layout.hpp).
  double unseen_depth() const { return clear_rise() / 2 + rounding; }
};

/// What a cap's rim or a side's end reaches over an edge, or a rim, by less than this part of its
/// size is not seen: of sizes and places that are equal rounding decides which is the longer.
inline constexpr double unseen_part = 2e-6;

/// Adds to `contact`, whose normal and signed distance are set, the points where the bodies face
/// each other across the normal; `origin` is where their frame lies in the world. Bodies:
/// cylinders, capsules, boxes, hulls.
///
/// The facing features' overlap across the normal is a point (one contact point), a segment (its
/// two ends) or a region bounded by lines and arcs (its corners and points on long arcs, at most
/// eight; three where it is a whole disc). Of features that lean, the part within the slack of the
/// deepest point counts, so that the points draw together as the tilt grows. Each lies halfway
/// between the surfaces along the normal, and one has the whole depth.
template <class Body>
void add_facing_points(Contact& contact, const PosedCylinder& a, const Body& b, const Vec3& origin,
                       double contact_threshold, PointRange range);

}  // namespace touchstone
