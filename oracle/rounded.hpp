#pragma once

#include <algorithm>
#include <cmath>

#include "reference/configuration.hpp"

// Rounded bodies, for tests.

namespace touchstone {

/// The body without its rounding, whose sizes have to be doubles: all others are as they are.
inline Shape core_of(const Shape& shape) {
  if (const auto* s = std::get_if<Cylinder>(&shape)) {
    return Cylinder(s->core_radius(), s->core_half_length());
  }
  if (const auto* s = std::get_if<Box>(&shape)) return Box(s->core_half_extents());
  return with_rounding(shape, 0);
}

/// The same bodies but for cylinders, boxes and hulls, which get a rounding of a power of two near
/// their smallest size around them. Sizes are rounded so that those of the cores are doubles.
inline Shape grown(const Shape& shape) {
  const auto around = [](double size) { return std::ldexp(1.0, std::ilogb(size)); };
  if (const auto* s = std::get_if<Cylinder>(&shape)) {
    const double by = around(std::min(s->radius(), s->half_length()));
    return Cylinder(s->radius() + by, s->half_length() + by, by);
  }
  if (const auto* s = std::get_if<Box>(&shape)) {
    const double by = around(s->half_extents().minCoeff());
    return Box(s->half_extents().array() + by, by);
  }
  return with_rounding(shape, around(smallest_half_extent(shape)));
}
inline Configuration grown(const Configuration& c) {
  return {std::get<Cylinder>(grown(Shape(c.a))), c.pose_a, grown(c.b), c.pose_b};
}
/// Both without their roundings.
inline Configuration cores_of(const Configuration& c) {
  return {std::get<Cylinder>(core_of(c.a)), c.pose_a, core_of(c.b), c.pose_b};
}

/// Both bodies with roundings that are these parts of their smallest sizes: 1 leaves a core that is
/// a disc, a segment, a point or a polygon's.
inline Configuration rounded_by(const Configuration& c, double part_a, double part_b) {
  const auto rounded = [](const Shape& shape, double part) {
    return std::holds_alternative<Plane>(shape)
               ? shape
               : with_rounding(shape, part * smallest_half_extent(shape));
  };
  return {std::get<Cylinder>(rounded(c.a, part_a)), c.pose_a, rounded(c.b, part_b), c.pose_b};
}

}  // namespace touchstone
