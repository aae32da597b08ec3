#pragma once

#include <vector>

#include "oracle/patch/convex_set.hpp"

namespace touchstone::oracle {

// Convex polygons as their vertices, counterclockwise. Two vertices are a segment, one is a point.

/// Extreme points of at least one point; those on a line with their neighbours are dropped,
/// exactly.
std::vector<Vec2> convex_hull(const std::vector<Vec2>& points);

/// What two convex polygons have in common, in double: empty where they miss each other, and maybe
/// where what they share is thinner than rounding.
std::vector<Vec2> intersection(const std::vector<Vec2>& p, const std::vector<Vec2>& q);

/// The point halfway between the nearest points of two convex polygons that do not meet, or cross
/// in less than rounding.
Vec2 halfway(const std::vector<Vec2>& p, const std::vector<Vec2>& q);

}  // namespace touchstone::oracle
