#pragma once

#include <string>
#include <vector>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/random_hulls_test.hpp"

namespace touchstone {

// Sweeps that tests draw: towards, through and past poses that are hard for contacts.

struct GivenSweep {
  Configuration c;
  Vec3 sweep;
};

/// A pose of any class, or of a hull.
inline Configuration any_pose(Pair pair, Random& random) {
  if (pair == Pair::convex) {
    return with_hull(hull_kinds[random.one_of(static_cast<int>(std::size(hull_kinds)))], random);
  }
  const std::vector<std::string>& classes = pose_classes(pair);
  const auto which = static_cast<std::size_t>(random.one_of(static_cast<int>(classes.size())));
  return make_configuration(
      {pair, classes[which], 1, static_cast<std::uint64_t>(random.one_of(1000000))});
}

/// A comes from a tenth to ten times the larger size away, seldom from up to a million times, and
/// passes the pose of a class somewhere; one in four in a direction across the normal there, so
/// that it grazes within 1e-17 to 1e-3 of the size.
inline GivenSweep random_sweep(Pair pair, Random& random) {
  Configuration c = any_pose(pair, random);
  const double size = larger_size(c);
  const double length = size * random.power_of_ten(-1, random.one_of(5) == 0 ? 6 : 1);
  Vec3 way = random.direction();
  Vec3 position = c.pose_a.position();
  if (random.one_of(4) == 0) {
    const SignedDistance found = signed_distance(c);
    way = (way - way.dot(found.normal) * found.normal).normalized();
    const double off = size * random.sign() * random.power_of_ten(-17, -3);
    position += (off - found.value) * found.normal;
  }
  const double gone = random.uniform(0, 1.2);
  c.pose_a = Pose(position - gone * length * way, c.pose_a.orientation());
  return {c, length * way};
}

/// What rounding may leave of a distance at a fraction in double, metres.
inline double distance_tolerance(const Configuration& there, const Vec3& sweep) {
  return promised * scale_of(there) + 0x1p-52 * sweep.norm();
}

}  // namespace touchstone
