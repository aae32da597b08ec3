#pragma once

#include <array>
#include <gmpxx.h>
#include <vector>

#include "oracle/ball.hpp"
#include "oracle/truth.hpp"
#include "reference/configuration.hpp"
#include "reference/pose.hpp"

namespace touchstone::oracle {

using RationalVector = Vector3<mpq_class>;

/// A pose in exact rationals: its axes are exactly orthogonal, each of the length `norm` = |q|²
/// (Euler–Rodrigues, without the division).
struct ExactPose {
  explicit ExactPose(const Pose& pose);
  /// A vector of the body's frame in the world, times norm.
  RationalVector turned(const RationalVector& v) const {
    return v.x * axes[0] + v.y * axes[1] + v.z * axes[2];
  }
  RationalVector position;
  std::array<RationalVector, 3> axes;
  mpq_class norm;
};

RationalVector exact(const Vec3& v);
/// Rounds each coordinate towards zero.
Vec3 rounded(const RationalVector& v);

/// The part of a body, or of a rounded one's core, in its support plane, seen along the normal.
/// Exact, except for points, whose coordinates may be irrational.
struct SupportFeature {
  enum class Kind { point, segment, disc, polygon, plane };
  Kind kind = Kind::point;

  Vec3 point = Vec3::Zero();  ///< for a point; world coordinates
  /// False where rounding decides which end of a feature the point is: the normal is irrational and
  /// nearly aligned with an axis.
  bool point_is_certain = true;

  // For the other kinds, exact up to multiples of the normal; metres.
  RationalVector centre;  ///< of a segment or disc
  RationalVector u;       ///< half of a segment; the axis of a disc, of any length
  mpq_class radius;
  /// Of a polygon, counterclockwise seen from outside; each is one.
  std::vector<RationalVector> corners;
};

/// The features of both bodies along a normal: A's lowest and B's highest.
struct SupportFeatures {
  SupportFeature a, b;
};
SupportFeatures support_features(const Configuration& configuration, const OptimalNormal& normal);

/// Points whose convex hull, seen along the unit vector n, is the part of a posed body (no plane)
/// within `epsilon` > 0 metres of its support plane along n. Curves are sampled, so that the hull
/// is inscribed. Positions are relative to `origin`; for spheres, capsules and rounded bodies their
/// component along n has no meaning.
std::vector<Vec3> support_part(const Shape& shape, const Pose& pose, const Vec3& n, double epsilon,
                               const Vec3& origin);

/// Those widths of the part that exist only because epsilon > 0: across a round side, a tilted cap,
/// an edge.
struct WidthFromEpsilon {
  double largest;    ///< metres; zero if the part contains a whole flat face
  bool is_a_corner;  ///< there are no other widths: the part shrinks to a point with epsilon
};
WidthFromEpsilon width_from_epsilon(const Shape& shape, const Pose& pose, const Vec3& n,
                                    double epsilon);

}  // namespace touchstone::oracle
