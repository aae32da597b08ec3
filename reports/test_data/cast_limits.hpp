#pragma once

#include "oracle/first_touch.hpp"
#include "reports/test_data/test_data.hpp"

namespace touchstone {

/// Which answers to a cast of A by a translation are right, if at an answered touch the bodies may
/// be apart or have overlapped by a tolerance. The signed distance is convex in time, so that these
/// touches are all those between two fractions.
struct CastLimits {
  AnswerLimits::Contact touch;        ///< must one be reported?
  double tolerance;                   ///< metres
  double min_fraction, max_fraction;  ///< of the sweep, in [0, 1]; 1 and 0 where it is forbidden
};

/// Each limit is the fraction at which the distance is the tolerance to within 1/1024 of it,
/// rounded outward to a multiple of a power of two, by no more than moves A by as much.
/// Precondition: the tolerance is at least 1e-12 of the length of the sweep.
CastLimits cast_limits(const Configuration& configuration, const Vec3& sweep,
                       const oracle::FirstTouch& truth, double tolerance);

}  // namespace touchstone
