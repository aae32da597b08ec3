#include "aabb.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

TEST(Aabb, ReachesAsFarAsTheSupportsAlongTheWorldsAxes) {
  for (const Pair pair : {Pair::sphere, Pair::capsule, Pair::cylinder, Pair::box}) {
    for (std::uint64_t i = 0; i < 50; ++i) {
      const Configuration c = make_configuration({pair, "general-deep", 5, i});
      const Aabb box = aabb(c.b, c.pose_b);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(box.upper[k], support(c.b, c.pose_b, Vec3::Unit(k)), 1e-14);
        EXPECT_NEAR(-box.lower[k], support(c.b, c.pose_b, -Vec3::Unit(k)), 1e-14);
      }
    }
  }
}

TEST(Aabb, OfBodiesThatTouchOverlap) {
  for (const Pair pair : all_pairs) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Configuration c = make_configuration({pair, "general-shallow", 6, i});
      EXPECT_TRUE(aabb(c.a, c.pose_a).overlaps(aabb(c.b, c.pose_b)));
    }
  }
}

TEST(Aabb, OfAHalfSpaceIsBoundedOnlyAlongItsNormal) {
  const Aabb ground = aabb(Plane({0, 0, 2}, 3), Pose({5, 6, 1}, {1, 0, 0, 0}));
  EXPECT_EQ(ground.upper.z(), 2.5);
  EXPECT_EQ(ground.lower.z(), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(ground.upper.x(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace touchstone
