#pragma once

#include <gmpxx.h>

#include "oracle/patch/convex_set.hpp"

namespace touchstone::oracle {

// Intersections of two flat features. All numbers are exact rationals, and every case is decided
// exactly: whether the intersection is a point, a segment or a region, and which lines and arcs
// bound it. Only their ends are then rounded to double. If the intersection is empty (the direction
// is not quite optimal) the result is the point of the second feature nearest to the first.
//
// CGAL's polygons of circles and lines (Gps_circle_segment_traits_2) find the same regions, but
// drop points and segments and take fifteen times as long; the tests compare these functions with
// them.

/// Two discs, the first about the origin, the second about (distance, 0).
ConvexSet overlap_of_discs(const mpq_class& radius, const mpq_class& other_radius,
                           const mpq_class& squared_distance);

/// A disc about (x, y) and the rectangle |x| <= a, |y| <= b.
ConvexSet overlap_of_disc_and_rectangle(const mpq_class& x, const mpq_class& y,
                                        const mpq_class& radius, const mpq_class& a,
                                        const mpq_class& b);

/// The segment |x| <= half_length of the x axis, and a disc in its plane whose centre is at x =
/// `along`, at the squared distance `squared_off` from the axis.
ConvexSet overlap_of_disc_and_segment(const mpq_class& along, const mpq_class& squared_off,
                                      const mpq_class& radius, const mpq_class& half_length);

/// The points (x, y) + t (dx, dy), |t| <= half_length, and the rectangle |x| <= a, |y| <= b.
ConvexSet overlap_of_segment_and_rectangle(const mpq_class& x, const mpq_class& y,
                                           const mpq_class& dx, const mpq_class& dy,
                                           const mpq_class& half_length, const mpq_class& a,
                                           const mpq_class& b);

/// |x| <= half_length and |x − along| <= other_half_length on the x axis.
ConvexSet overlap_of_segments(const mpq_class& half_length, const mpq_class& along,
                              const mpq_class& other_half_length);

}  // namespace touchstone::oracle
