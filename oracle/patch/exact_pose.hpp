#pragma once

#include <array>
#include <gmpxx.h>

#include "oracle/vector3.hpp"
#include "reference/pose.hpp"

namespace touchstone::oracle {

using RationalVector = Vector3<mpq_class>;

/// The doubles of a pose as they are: its axes, all of the length `norm` = |q|², are exactly
/// orthogonal and rational (Euler and Rodrigues, without the division).
struct ExactPose {
  explicit ExactPose(const Pose& pose);
  RationalVector position;
  std::array<RationalVector, 3> axes;
  mpq_class norm;
};

RationalVector exact(const Vec3& v);
/// Nearly the nearest doubles (each rounded towards zero).
Vec3 rounded(const RationalVector& v);

}  // namespace touchstone::oracle
