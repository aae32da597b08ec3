// How the few points of a flat patch follow its slope: the deepest one comes, what is above is cut
// off, and no more than eight are left.
#include "reference/patch_layout.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace touchstone {
namespace {

PatchLayout polygon(int corners) {
  PatchLayout layout(1);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    layout.add({std::cos(angle), std::sin(angle)});
  }
  return layout;
}
bool has(const PatchLayout& layout, const Vec2& p) {
  return std::any_of(layout.points.begin(), layout.points.begin() + layout.count,
                     [&](const Vec2& q) { return (p - q).norm() < 1e-12; });
}

TEST(PatchLayout, DeepestPointGrowsOutOfTheMiddle) {
  const Vec2 deepest(0, -0.9);
  for (const double weight : {0.25, 1.0}) {
    PatchLayout layout = polygon(5);
    layout.add_deepest(deepest, weight);
    EXPECT_EQ(layout.count, 6);
    EXPECT_TRUE(has(layout, weight * deepest));
  }
  PatchLayout layout = polygon(4);
  layout.add_deepest({0, -1}, 1);  // a corner
  EXPECT_EQ(layout.count, 4);
}

TEST(PatchLayout, TwoOfEightBecomeOneAsTheDeepestLeavesTheirHull) {
  const Vec2 deepest(-0.95, 0.3);
  for (const double weight : {0.1, 0.9, 1.0}) {
    PatchLayout layout = polygon(8);
    layout.points[1] = layout.points[0] + 0.1 * (layout.points[1] - layout.points[0]);
    const Vec2 between = (layout.points[0] + layout.points[1]) / 2;
    layout.add_deepest(deepest, weight);
    layout.reduce();
    EXPECT_EQ(layout.count, 8);
    EXPECT_EQ(has(layout, between), weight == 1) << weight;
    EXPECT_EQ(has(layout, deepest), weight == 1) << weight;
  }
}

TEST(PatchLayout, HullIsCutOffWhereItRisesAboveTheBound) {
  PatchLayout square(1);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) square.add({x, y});
  }
  square.cut_off({0, 2}, 1);  // y <= 1/2
  EXPECT_EQ(square.count, 4);
  for (const double x : {-1.0, 1.0}) {
    EXPECT_TRUE(has(square, {x, -1}));
    EXPECT_TRUE(has(square, {x, 0.5}));
  }
  square.cut_off({0, 2}, 3);  // nothing of it
  EXPECT_EQ(square.count, 4);
}

TEST(PatchLayout, WhatIsWithinTheOthersGivesWayFirst) {
  PatchLayout layout = polygon(8);
  layout.add({0.1, 0.2});
  layout.add({-0.3, 0});
  layout.reduce();
  EXPECT_EQ(layout.count, 8);
  const PatchLayout whole = polygon(8);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(has(layout, whole.points[i]));
}

}  // namespace
}  // namespace touchstone
