#pragma once

#include <string>
#include <vector>

#include "properties/casts.hpp"
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

}  // namespace touchstone
