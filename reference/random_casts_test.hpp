#pragma once

#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "oracle/first_touch.hpp"
#include "oracle/judge/cast_score.hpp"
#include "properties/casts.hpp"
#include "reference/cast.hpp"
#include "reference/contact_of.hpp"
#include "reference/random_bodies_test.hpp"

namespace touchstone {

// What tests of casts share.

/// Any motion upon a pose of any class.
inline CastIdentity any_cast(Pair pair, Random& random) {
  const std::vector<std::string>& classes = pose_classes(pair);
  const auto one_of = [&](std::size_t count) {
    return static_cast<std::size_t>(random.one_of(static_cast<int>(count)));
  };
  const Identity pose{pair, classes[one_of(classes.size())], 1, one_of(1000000)};
  return {pose, &cast_motions()[one_of(cast_motions().size())]};
}
/// A pose of any class.
inline Configuration any_pose(Pair pair, Random& random) {
  return make_configuration(any_cast(pair, random).pose);
}

/// What rounding may leave of a distance at a fraction in double, metres.
inline double distance_tolerance(const Configuration& there, const Vec3& sweep) {
  return promised * scale_of(there) + 0x1p-52 * sweep.norm();
}

/// Our casts, each held against the truth.
struct HeldCasts {
  int touches = 0, nevers = 0;  ///< in truth

  Cast hold(const Configuration& c, const Vec3& sweep) {
    const Cast found = cast(c, sweep);
    const oracle::FirstTouch truth = oracle::first_touch(c, Sweep(sweep));
    const Configuration there = swept(c, Sweep(sweep), found.fraction);
    const Bar bar{.tolerance = distance_tolerance(there, sweep) / smaller_size(c)};
    const CastScore score = score_cast(c, Sweep(sweep), truth, found, bar);
    EXPECT_EQ(score.outcome, CastOutcome::agree)
        << outcome_name(score.outcome) << ", touch at " << found.fraction << ", distance "
        << score.distance.value_or(NAN) * error_size(c, bar) << ", normal's regret "
        << score.normal_regret.value_or(NAN);
    touches += truth.status == oracle::FirstTouch::Status::touch;
    nevers += truth.status == oracle::FirstTouch::Status::never;
    return found;
  }
};

}  // namespace touchstone
