#pragma once

#include "oracle/optimal_normal.hpp"
#include "oracle/patch/exact_pose.hpp"

namespace touchstone::oracle {

/// What of a body lies in its support plane, seen along the normal: exactly, but for points, whose
/// coordinates may be irrational.
struct SupportFeature {
  enum class Kind { point, segment, disc, rectangle, plane };
  Kind kind = Kind::point;

  Vec3 point = Vec3::Zero();  ///< of a point, world coordinates
  /// Nearly every point of a body is as certain as the normal. Not so where the normal is
  /// irrational and all but aligned with an axis: rounding then decides which end of the feature it
  /// is.
  bool point_is_certain = true;

  // Of the others; u and v have the length norm, and half extents are metres.
  RationalVector centre;  ///< up to a multiple of the normal
  RationalVector u;       ///< along a segment, across a disc, along a rectangle's side
  RationalVector v;       ///< along a rectangle's other side
  mpq_class norm, half_u, half_v, radius;
};

/// Both bodies' features along a normal: A's lowest and B's highest.
struct SupportFeatures {
  SupportFeature a, b;
};
SupportFeatures support_features(const Configuration& configuration, const OptimalNormal& normal);

}  // namespace touchstone::oracle
