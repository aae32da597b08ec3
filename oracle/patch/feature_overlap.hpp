#pragma once

#include <optional>

#include "oracle/patch/convex_set.hpp"
#include "oracle/patch/support_feature.hpp"

namespace touchstone::oracle {

/// A plane set, and the world frame of its coordinates.
struct Placement {
  ConvexSet shape;
  Vec3 origin;
  Vec3 e1;  ///< perpendicular to the normal up to rounding, of any length
};

/// Where two features overlap, seen along the unit vector n from B to A. Every case is decided in
/// exact rationals: whether the overlap is a point, a segment or a region, and which lines and arcs
/// bound it. Only their ends are then rounded to double. A point feature's overlap is that point.
/// None if two segments that are not parallel miss each other; if others do (the direction is not
/// quite optimal), the point of the second feature nearest to the first.
///
/// CGAL's polygons of circles and lines (Gps_circle_segment_traits_2) find the same regions, but
/// drop points and segments and take fifteen times as long; the tests compare this with them.
std::optional<Placement> overlap(const SupportFeature& a, const SupportFeature& b, const Vec3& n);

}  // namespace touchstone::oracle
