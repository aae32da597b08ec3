#include "disc_layout.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace touchstone {
namespace {

constexpr double radius = 2, slack = 1e-3, clear_rise = 1e-6 * radius;

std::vector<Vec2> layout(const Vec2& slope) {
  std::array<Vec2, 6> arms;
  const int count = spread_disc(radius, slope, Vec2(0.6, 0.8), slack, clear_rise, arms);
  return {arms.begin(), arms.begin() + count};
}
Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// How far above its lowest place the disc is there, metres.
double rise(const Vec2& arm, const Vec2& slope) { return slope.dot(arm) + radius * slope.norm(); }

TEST(DiscLayout, LevelDiscHasThreePointsWhicheverWayRoundingTiltsIt) {
  const std::vector<Vec2> level = layout(Vec2(0, 0));
  ASSERT_EQ(level.size(), 3u);
  EXPECT_NEAR((level[0] - radius * Vec2(0.6, 0.8)).norm(), 0, 1e-15);
  EXPECT_NEAR((level[0] - level[1]).norm(), radius * std::sqrt(3.0), 1e-15);
  EXPECT_NEAR((level[2] - level[1]).norm(), radius * std::sqrt(3.0), 1e-15);
  for (double angle = 0; angle < 6.3; angle += 0.1) {
    for (double steepness = 1e-18; steepness < 4e-7; steepness *= 10) {
      EXPECT_EQ(layout(steepness * direction(angle)), level);
    }
  }
}

TEST(DiscLayout, HasTheLowestPointOfADiscThatClearlyLeans) {
  for (double angle = 0; angle < 6.3; angle += 0.1) {
    for (double steepness = 1.01e-6; steepness < 0.01; steepness *= 1.3) {
      const Vec2 slope = steepness * direction(angle);
      double lowest = slack;
      for (const Vec2& arm : layout(slope)) {
        lowest = std::min(lowest, rise(arm, slope));
        EXPECT_LE(arm.norm(), radius * (1 + 1e-15));
        EXPECT_LE(rise(arm, slope), slack * (1 + 1e-12));
      }
      EXPECT_NEAR(lowest, 0, 1e-17);
    }
  }
}

TEST(DiscLayout, LessSlackThanTheTiltTakesLeavesThreePointsAboutTheLowest) {
  const Vec2 slope(5e-4, 0);  // rises by the slack over half of the disc
  const std::vector<Vec2> points = layout(slope);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_NEAR((points[0] - Vec2(-radius, 0)).norm(), 0, 1e-15);
  for (const int side : {1, 2}) EXPECT_NEAR(rise(points[side], slope), slack, 1e-15);
}

TEST(HandOver, GrowsTheNewBeforeItShrinksTheOld) {
  EXPECT_FALSE(HandOver{0}.has_begun());
  EXPECT_EQ(HandOver{1}.new_size(), 1);
  EXPECT_EQ(HandOver{1}.old_size(), 1);
  EXPECT_EQ(HandOver{0.5}.new_size(), 0.75);
  EXPECT_EQ(HandOver{1.5}.old_size(), 0.75);
  EXPECT_TRUE(HandOver{2}.is_over());
}

}  // namespace
}  // namespace touchstone
