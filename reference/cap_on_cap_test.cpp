#include "cap_on_cap.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "reference/patch_points_test.hpp"

namespace touchstone {
namespace {

/// A disc of radius 1, and one of that radius so far along x.
CapOnCap lens_of(double radius, double apart) {
  return {{Vec2(0, 0), 1}, {Vec2(apart, 0), radius}, Vec2(0.6, 0.8)};
}

TEST(CapOnCap, EndsWhereTheCirclesCross) {
  const CapOnCap lens = lens_of(1, 1);
  EXPECT_NEAR((lens.middle() - Vec2(0.5, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((lens.farthest(Vec2(0, 1)) - Vec2(0, std::sqrt(0.75))).norm(), 0, 1e-15);
  EXPECT_NEAR((lens.farthest(Vec2(1, 0)) - Vec2(0.5, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((lens.farthest(Vec2(-1, 0)) - Vec2(-0.5, 0)).norm(), 0, 1e-15);
}

TEST(CapOnCap, IsEmptyWhereTheRimsOnlyTouch) {
  EXPECT_FALSE(lens_of(2, 2.99).empty());
  const CapOnCap touching = lens_of(2, 3);
  EXPECT_TRUE(touching.empty());
  EXPECT_NEAR((touching.middle() + touching.nearest() - Vec2(1, 0)).norm(), 0, 1e-15);
}

TEST(CapOnCap, HasFourPointsOrFiveOnTheWayFromOneWayToPlaceThemToAnother) {
  std::size_t most = 0;
  for (double radius = 0.3; radius < 3; radius *= 1.2) {
    const double nearest = std::abs(1 - radius) + 0.02 * std::min(1.0, radius);
    for (double apart = nearest; apart < 0.98 * (1 + radius); apart += 0.02) {
      const CapOnCap lens = lens_of(radius, apart);
      const std::size_t count = distinct_points(lens, Vec2(0, 0), 0).size();
      EXPECT_GE(count, 4u) << radius << " " << apart;
      EXPECT_GE(coverage(lens), 0.6) << radius << " " << apart;
      most = std::max(most, count);
    }
  }
  EXPECT_EQ(most, 5u);
}

TEST(CapOnCap, PointsLieInThePatchAndHoldTheDeepestPlaceIfThatIsClear) {
  EXPECT_TRUE(rc::check([&] {
    const double radius = 1e-3 * *rc::gen::inRange(300, 3000);
    // Also where the disc's points are all but handed over to the lens's.
    const double part =
        *rc::gen::element(0.0, 1e-4, 3e-3, 0.00500025, 0.00810025, 0.02, 0.1, 0.5, 0.9, 0.99);
    const CapOnCap patch = lens_of(radius, std::abs(1 - radius) + part * 2 * std::min(radius, 1.0));
    const Vec2 down = direction(1e-3 * *rc::gen::inRange(0, 6284));
    const double clearness = 0.1 * *rc::gen::inRange(0, 11);
    const auto points = distinct_points(patch, down, clearness);
    RC_ASSERT(points.size() <= 8u);
    double deepest = -2;
    for (const Vec2& p : points) {
      for (int i = 0; i < 64; ++i) {
        const Vec2 n = direction(i);
        RC_ASSERT(n.dot(p) <= n.dot(patch.farthest(n)) + 1e-6);
      }
      deepest = std::max(deepest, down.dot(p));
    }
    if (clearness == 1) RC_ASSERT(deepest >= down.dot(patch.farthest(down)) - 1e-12);
  }));
}

}  // namespace
}  // namespace touchstone
